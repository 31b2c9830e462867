#pragma once

#include <omnimapper/map/Layers.h>
#include <omnimapper/map/Map.h>

#include <Eigen/Core>
#include <map>
#include <string>

namespace rooms_layer {

// Step 1: the layer. It is plain data with the members that map::LayerOf asks for, and knows no plugin.

/// Where a room is. It is anchored to a key frame, so that it moves with the map when a loop is closed.
struct Room {
  double power = 0;  ///< [dBm] with which its tag was read there
  omnimapper::base::Stamp read_at;
  omnimapper::base::KeyFrameId frame;
  Eigen::Vector3d in_frame;  ///< [m] in the base frame of the key frame

  /// [m] where it is by the latest estimate.
  Eigen::Vector3d inMap(const omnimapper::map::Map& map) const;
};

/// The layer "room_tags" of a map.
struct Rooms {
  static constexpr char kLayer[] = "room_tags";
  static constexpr std::uint32_t kLayerVersion = 1;

  std::map<std::string, Room> rooms;  ///< by name

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is of a later version or damaged.
  static Rooms fromSection(const omnimapper::map::MapSection& section);
  /// A map that lacks one of these key frames is damaged, and is refused when it is read.
  omnimapper::map::LayerReferences references() const;
};

}  // namespace rooms_layer
