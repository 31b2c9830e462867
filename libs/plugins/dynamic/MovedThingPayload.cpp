#include "MovedThingPayload.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/ByteIo.h>

namespace omnimapper::plugins {

namespace {

constexpr std::uint64_t kMovedThingVersion = 1;

void writeStamp(std::ostream& out, base::Stamp stamp) {
  graph::writeUint(out, static_cast<std::uint64_t>(stamp.time_since_epoch().count()), 8);
}

base::Stamp readStamp(std::istream& in) {
  return base::Stamp(base::Duration(static_cast<std::int64_t>(graph::readUint(in, 8))));
}

}  // namespace

map::LandmarkShape MovedThingPayload::shape(const std::vector<Eigen::VectorXd>&,
                                            const map::KeyFrames& key_frames) const {
  map::LandmarkShape shape;
  shape.label = label;
  for (const ObservedPlace& place : places) {
    const Eigen::Vector3d point =
        geometry::fromMrpt(key_frames.at(place.seen_from).map_from_base) * place.point_in_base;
    shape.points.push_back(point);
    shape.point_stamps.push_back(place.last_seen);
    const std::string number = "place_" + std::to_string(shape.points.size());
    shape.properties.push_back({number + "_first_seen", place.first_seen});
    shape.properties.push_back({number + "_last_seen", place.last_seen});
    shape.properties.push_back({number + "_measurements", std::uint64_t{place.measurements}});
  }
  return shape;
}

std::vector<base::KeyFrameId> MovedThingPayload::keyFrames() const {
  std::vector<base::KeyFrameId> frames;
  for (const ObservedPlace& place : places) frames.push_back(place.seen_from);
  return frames;
}

void MovedThingPayload::write(std::ostream& out) const {
  graph::writeUint(out, kMovedThingVersion, 1);
  graph::writeId(out, landmark);
  graph::writeText(out, label);
  graph::writeUint(out, places.size(), 4);
  for (const ObservedPlace& place : places) {
    graph::writeId(out, place.seen_from);
    graph::writeVector(out, place.point_in_base);
    writeStamp(out, place.first_seen);
    writeStamp(out, place.last_seen);
    graph::writeUint(out, place.measurements, 4);
  }
}

void MovedThingPayload::addTo(map::PayloadRegistry& registry) {
  registry.add("moved thing", [](std::istream& in) {
    if (const auto version = graph::readUint(in, 1); version > kMovedThingVersion) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "a moved thing of version " + std::to_string(version) + ": this program reads versions up to " +
                            std::to_string(kMovedThingVersion) + "; take the OmniMapper that wrote the map");
    }
    auto payload = std::make_shared<MovedThingPayload>();
    payload->landmark = graph::readId<base::LandmarkId>(in);
    payload->label = graph::readText(in);
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      ObservedPlace place;
      place.seen_from = graph::readId<base::KeyFrameId>(in);
      place.point_in_base = graph::readVector<3>(in);
      place.first_seen = readStamp(in);
      place.last_seen = readStamp(in);
      place.measurements = static_cast<std::uint32_t>(graph::readUint(in, 4));
      payload->places.push_back(place);
    }
    return payload;
  });
}

}  // namespace omnimapper::plugins
