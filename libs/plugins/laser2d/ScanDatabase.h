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

/// What key frames of a map saw, where they lay when this was made, and the relocalizer over all of it, which is made
/// by whichever thread asks first. Never changes else, so threads may share it.
class ScanDatabase {
 public:
  struct Place {
    LoopSearch::KeyScan key_scan;
    mrpt::math::TPose2D map_from_base;
  };

  /// Of `key_scans`, by the label of their clouds, those of sessions that are joined. `map` has at least one key frame.
  ScanDatabase(const map::Map& map, const std::map<std::string, std::vector<LoopSearch::KeyScan>>& key_scans,
               std::shared_ptr<const matching::ScanMatcher> matcher, const matching::RelocalizerOptions& options = {});

  bool empty() const { return places_.empty(); }
  /// Those where the sensor saw the most alike, by distance and heading: the nearest first.
  std::vector<Place> nearest(const mrpt::math::TPose2D& map_from_base, std::size_t count) const;
  /// What is known of a session that may lie anywhere in it.
  const mapper::SessionStart& anywhere() const { return anywhere_; }
  /// Throws Error(out_of_range) for a map too large for its grids.
  const matching::Relocalizer& relocalizer() const;

 private:
  std::vector<Place> places_;
  std::vector<map::KeyFrame> frames_;  // of each place; a copy of the map would be the engine's to destroy
  std::vector<std::string> labels_;    // of the cloud, for each place
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  matching::RelocalizerOptions options_;
  mapper::SessionStart anywhere_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const matching::Relocalizer> relocalizer_;
  mutable std::string too_large_;
};

/// What a laser saw from a key frame, in its base; it stands where the sensor is and is turned as the base: the beams
/// of the raw scan that the cloud `cloud_label` was made of, or the points of the cloud where only that was kept.
matching::LocalScan beamsInBase(const map::KeyFrame& frame, const std::string& cloud_label);

}  // namespace omnimapper::plugins
