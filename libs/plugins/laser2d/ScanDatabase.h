#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/matching/Relocalizer.h>
#include <omnimapper/plugin/SessionStart.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "LoopSearch.h"

namespace omnimapper::plugins {

/// The scans of key frames of a map, at the poses they had when the database was made, and a relocalizer over all of
/// them. The first thread that needs the relocalizer builds it. All else is immutable, so threads may share a database.
class ScanDatabase {
 public:
  struct Place {
    LoopSearch::KeyScan key_scan;
    mrpt::math::TPose2D map_from_base;
  };

  /// `key_scans`: by the label of their clouds. Those of sessions that are not aligned with the map
  /// (map::Session::aligned) are left out. `map` has at least one key frame.
  ScanDatabase(const map::Map& map, const std::map<std::string, std::vector<LoopSearch::KeyScan>>& key_scans,
               std::shared_ptr<const matching::ScanMatcher> matcher, const matching::RelocalizerOptions& options = {});

  bool empty() const { return places_.empty(); }
  /// The `count` places with the most similar views, judged by distance and heading, the most similar first.
  std::vector<Place> nearest(const mrpt::math::TPose2D& map_from_base, std::size_t count) const;
  /// The start of a session that may lie anywhere in the map.
  const mapper::SessionStart& anywhere() const { return anywhere_; }
  /// Throws Error(out_of_range) if the map is too large for the grids of the relocalizer.
  const matching::Relocalizer& relocalizer() const;
  /// Whether the map is small enough for relocalizer().
  bool hasRelocalizer() const;

 private:
  void makeRelocalizer() const;

  std::vector<Place> places_;
  // The key frame of each place. No copy of the map is kept, because only the engine's thread may destroy one.
  std::vector<map::KeyFrame> frames_;
  std::vector<std::string> labels_;  // of the cloud, for each place
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  matching::RelocalizerOptions options_;
  mapper::SessionStart anywhere_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const matching::Relocalizer> relocalizer_;
  mutable std::string too_large_;
};

/// The scan of a laser at a key frame, in a frame at the sensor with the axes of the base: the beams of the raw scan
/// from which the cloud `cloud_label` was made, or the points of that cloud if the scan was not kept.
matching::LocalScan beamsInBase(const map::KeyFrame& frame, const std::string& cloud_label);

}  // namespace omnimapper::plugins
