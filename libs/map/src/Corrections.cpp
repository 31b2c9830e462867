#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/Map.h>

#include <sstream>
#include <variant>

#include "SectionBytes.h"

namespace omnimapper::map {

std::string Corrections::toBytes() const {
  ByteWriter out;
  out.uint(deleted.size(), 4);
  for (const auto& thing : deleted) {
    Places one;
    one.places = {thing.place};
    out.block(one.toBytes());
    out.block(thing.who);
    writeStamp(out, thing.when);
  }
  out.uint(forbidden.size(), 4);
  for (const auto& loop : forbidden) {
    writeId(out, loop.from);
    writeId(out, loop.to);
    out.block(loop.who);
    writeStamp(out, loop.when);
  }
  return out.take();
}

Corrections Corrections::fromSection(const MapSection& section) {
  expectSection(section, kLayer, kLayerVersion);
  ByteReader in(section.bytes, placeOf(kLayer));
  Corrections read;
  for (auto left = in.uint(4); left > 0; --left) {
    auto places = Places::fromSection({Places::kLayer, Places::kLayerVersion, std::string(in.block())}).places;
    if (places.size() != 1) refuse(kLayer, "has a deletion that is not of one thing: the file is damaged");
    const std::string who(in.block());
    read.deleted.push_back({std::move(places.front()), who, readStamp(in)});
  }
  for (auto left = in.uint(4); left > 0; --left) {
    ForbiddenLoop loop;
    loop.from = readId<base::KeyFrameTag>(in);
    loop.to = readId<base::KeyFrameTag>(in);
    loop.who = std::string(in.block());
    loop.when = readStamp(in);
    read.forbidden.push_back(std::move(loop));
  }
  expectEnd(in, kLayer);
  return read;
}

LayerReferences Corrections::references() const {
  LayerReferences references;
  for (const auto& thing : deleted)
    for (const auto id : landmarksOf(thing.place)) references.landmarks.push_back(id);
  for (const auto& loop : forbidden)
    for (const auto id : {loop.from, loop.to}) references.key_frames.push_back(id);
  return references;
}

std::vector<base::LandmarkId> landmarksOf(const Place& place) {
  std::vector<base::LandmarkId> ids{place.id};
  for (const auto& property : place.properties) {
    const auto* text = std::get_if<std::string>(&property.value);
    if (property.name != kParts || !text) continue;
    std::istringstream in(*text);
    base::LandmarkId id;
    for (char colon = 0, comma = 0; in >> id.session >> colon >> id.index && colon == ':'; in >> comma)
      if (id != place.id) ids.push_back(id);
  }
  return ids;
}

std::set<base::LandmarkId> deletedLandmarks(const Map& map) {
  std::set<base::LandmarkId> ids;
  if (const auto* corrections = map.layers.find<Corrections>())
    for (const auto& thing : corrections->deleted)
      for (const auto id : landmarksOf(thing.place)) ids.insert(map.landmark(id).id);
  return ids;
}

}  // namespace omnimapper::map
