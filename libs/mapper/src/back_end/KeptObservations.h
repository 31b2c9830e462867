#pragma once

#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/plugin/OutputPlugin.h>

#include <unordered_set>
#include <vector>

namespace omnimapper::mapper {

/// What key frames keep of images: a thinned cloud, and of the images themselves no more than an output asks for. A
/// place that was seen before adds no points, so that the cloud grows with the place and not with the log.
class KeptObservations {
 public:
  /// `map` stays the caller's.
  KeptObservations(const CloudOptions& cloud, RawImages images, map::Map& map)
      : cloud_(cloud), images_(images), map_(map) {}

  /// Counts the points of a map that was loaded as seen.
  void resume();
  /// Takes those of the points, in the base of the key frame, that lie where the map has none yet.
  void addCloud(base::KeyFrameId id, const std::vector<map::CloudPoint>& points);
  /// Replaces images that nobody keeps by observations of the same sensor and stamp without them.
  void dropImages(base::KeyFrameId id);

 private:
  CloudOptions cloud_;
  RawImages images_;
  map::Map& map_;
  std::unordered_set<std::uint64_t> taken_;  // cubes of the map that have a point
};

}  // namespace omnimapper::mapper
