#pragma once

#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/map/Layers.h>

#include <nlohmann/json.hpp>

#include "TwoRooms.h"

namespace omnimapper::query {

/// The map of two rooms in a file as a run writes it, with what labels need: key frame 0:0 at (1, 1), 0:1 at (6, 1),
/// which looks along y; landmarks for the places, and landmark 0:6, which was merged into the counter, 0:1.
class MapWithFrames : public TwoRooms {
 protected:
  MapWithFrames() {
    // The table is a thing of two faces.
    map_.places.places[3].properties = {{map::kParts, "0:3, 0:9"}};
  }
  void write() const {
    map::Map map;
    map.key_frames.insert(frameAt({0, 0}, {1, 1, 0, 0, 0, 0}));
    map.key_frames.insert(frameAt({0, 1}, {6, 1, 0, M_PI / 2, 0, 0}));
    for (std::uint32_t i = 0; i < 7; ++i) map.landmarks.add(0, landmark(i));
    map::MapFile file;
    file.set(map::framesToSection(map));
    file.set(map::landmarksToSection(map));
    file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(map_.places)));
    building::Building building;
    building.storeys = {*map_.rooms};
    file.set({building::kRoomsLayer, building::kRoomsLayerVersion, building::encodeRooms(building)});
    file.write(map_.file);
  }

  base::Stamp start_ = base::stampFromUnix(1'700'000'000);  // of key frame 0:0; 0:1 is 1 s later

 private:
  map::KeyFrame frameAt(base::KeyFrameId id, const mrpt::poses::CPose3D& pose) const {
    map::KeyFrame frame;
    frame.id = id;
    frame.stamp = start_ + base::durationFromSeconds(id.index);
    frame.map_from_base = pose;
    return frame;
  }
  static map::Landmark landmark(std::uint32_t index) {
    map::Landmark landmark;
    landmark.id = {0, index};
    landmark.kind = "thing";
    if (index == 6) {
      landmark.state = map::Landmark::State::merged;
      landmark.merged_into = {0, 1};
    }
    return landmark;
  }
};

}  // namespace omnimapper::query
