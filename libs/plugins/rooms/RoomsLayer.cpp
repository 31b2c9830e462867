#include "RoomsLayer.h"

#include <omnimapper/plugin/SavedVariable.h>

namespace omnimapper::plugins {

std::string RoomsLayer::toBytes() const {
  return building::encodeRooms(rooms);
}

RoomsLayer RoomsLayer::fromSection(const map::MapSection& section) {
  mapper::expectVersion(section, kLayerVersion);
  return {building::decodeRooms(section.bytes, "map file, section \"" + section.name + "\"")};
}

map::LayerReferences RoomsLayer::references() const {
  map::LayerReferences references;
  for (const auto& storey : rooms.building.storeys)
    for (const auto& room : storey.rooms)
      if (room.anchor) references.key_frames.push_back(room.anchor->frame);
  return references;
}

}  // namespace omnimapper::plugins
