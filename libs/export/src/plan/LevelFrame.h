#pragma once

#include <omnimapper/geometry/Se3.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <vector>

#include "plan/LandmarkShapes.h"
#include "run/Closures.h"

namespace omnimapper::exports {

/// What drawings from above are made in: the frame of the map, turned so that up is z. Where the map's z is up, or
/// nobody knows, that is the map's own frame, and everything stays as it is to the last bit.
class LevelFrame {
 public:
  explicit LevelFrame(const map::Map& map);

  bool isOfMap() const { return is_of_map_; }
  Eigen::Vector3d operator()(const Eigen::Vector3d& in_map) const { return level_from_map_ * in_map; }
  std::vector<ShapedLandmark> operator()(std::vector<ShapedLandmark> landmarks) const;
  std::vector<map::StampedPose> operator()(std::vector<map::StampedPose> trajectory) const;
  std::vector<Closure> operator()(std::vector<Closure> closures) const;
  /// Its key frames; landmarks and graph stay as they are.
  map::Map operator()(map::Map map) const;

 private:
  bool is_of_map_ = true;
  geometry::Se3 level_from_map_;
};

}  // namespace omnimapper::exports
