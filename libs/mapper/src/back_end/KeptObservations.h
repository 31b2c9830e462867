#pragma once

#include <omnimapper/geometry/CubeSet.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/plugin/OutputPlugin.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace omnimapper::mapper {

/// Reduces what key frames keep of images: a thinned point cloud, and of the images themselves only what an output
/// needs. A place that was seen before adds no points, so the cloud grows with the place and not with the log.
class KeptObservations {
 public:
  /// The caller owns `map`.
  KeptObservations(const CloudOptions& cloud, RawImages images, map::Map& map)
      : cloud_(cloud), images_(images), map_(map), cubes_(cloud.voxel) {}

  /// From now on, at least these images are kept.
  void keepAtLeast(RawImages images) { images_ = std::max(images_, images); }
  /// Must be called after a map was loaded or a solve moved poses: the occupied cubes are computed again if points may
  /// have moved to other cubes.
  void posesChanged();
  /// Adds to the key frame those of `points`, given in its base frame, that lie where the map has none yet.
  void addCloud(base::KeyFrameId id, const std::vector<map::CloudPoint>& points);
  /// Replaces observations whose images are not kept by copies of the same sensor and stamp without images.
  void dropImages(base::KeyFrameId id);

 private:
  bool takes(const map::KeyFrame& frame, const map::CloudPoint& point);

  CloudOptions cloud_;
  RawImages images_;
  map::Map& map_;
  geometry::CubeSet cubes_;  // cubes of the map that contain a point
  std::unordered_map<base::KeyFrameId, mrpt::poses::CPose3D>
      seen_from_;  // pose with which the points of a key frame are in cubes_
};

}  // namespace omnimapper::mapper
