#pragma once

#include <omnimapper/geometry/CubeSet.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/plugin/OutputPlugin.h>

#include <unordered_map>
#include <vector>

namespace omnimapper::mapper {

/// What key frames keep of images: a thinned cloud, and of the images themselves no more than an output asks for. A
/// place that was seen before adds no points, so that the cloud grows with the place and not with the log.
class KeptObservations {
 public:
  /// `map` stays the caller's.
  KeptObservations(const CloudOptions& cloud, RawImages images, map::Map& map)
      : cloud_(cloud), images_(images), map_(map), cubes_(cloud.voxel) {}

  /// To be called when a map was loaded or a solve has moved poses: what counts as seen is where its points are now, if
  /// that is another cube.
  void posesChanged();
  /// Takes those of the points, in the base of the key frame, that lie where the map has none yet.
  void addCloud(base::KeyFrameId id, const std::vector<map::CloudPoint>& points);
  /// Replaces images that nobody keeps by observations of the same sensor and stamp without them.
  void dropImages(base::KeyFrameId id);

 private:
  bool takes(const map::KeyFrame& frame, const map::CloudPoint& point);

  CloudOptions cloud_;
  RawImages images_;
  map::Map& map_;
  geometry::CubeSet cubes_;                                               // of the map that have a point
  std::unordered_map<base::KeyFrameId, mrpt::poses::CPose3D> seen_from_;  // by which they are in these
};

}  // namespace omnimapper::mapper
