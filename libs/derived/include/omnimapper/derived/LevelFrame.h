#pragma once

#include <omnimapper/derived/Closures.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <vector>

namespace omnimapper::derived {

/// The frame for drawings from above: the map's frame, rotated so that up is z. If the map's z is up, or up is unknown,
/// it is the map's own frame, and everything stays bit-identical.
class LevelFrame {
 public:
  explicit LevelFrame(const map::Map& map);

  bool isOfMap() const { return is_of_map_; }
  Eigen::Vector3d operator()(const Eigen::Vector3d& in_map) const { return level_from_map_ * in_map; }
  std::vector<ShapedLandmark> operator()(std::vector<ShapedLandmark> landmarks) const;
  std::vector<map::StampedPose> operator()(std::vector<map::StampedPose> trajectory) const;
  std::vector<Closure> operator()(std::vector<Closure> closures) const;
  /// Rotates the key frames; landmarks and graph stay unchanged.
  map::Map operator()(map::Map map) const;

 private:
  bool is_of_map_ = true;
  geometry::Se3 level_from_map_;
};

}  // namespace omnimapper::derived
