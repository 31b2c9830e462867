#pragma once

#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/map/Layers.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// The layer "rooms" of a map: the document rooms.json. Each room is anchored to a key frame near it.
struct RoomsLayer {
  static constexpr const char* kLayer = building::kRoomsLayer;
  static constexpr std::uint32_t kLayerVersion = building::kRoomsLayerVersion;

  building::RoomsDocument rooms;

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is of a later version or damaged.
  static RoomsLayer fromSection(const map::MapSection& section);
  map::LayerReferences references() const;
};

}  // namespace omnimapper::plugins
