#pragma once

#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/PayloadRegistry.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// A place where a landmark was seen for some time.
struct ObservedPlace {
  base::KeyFrameId seen_from;     ///< the last key frame from which the landmark was seen there
  Eigen::Vector3d point_in_base;  ///< [m] middle of the landmark, in the base of that key frame
  base::Stamp first_seen, last_seen;
  std::uint32_t measurements = 0;
};

/// The record of a landmark that was moved: the places where it was seen, so that it can be looked for there (thesis
/// 4.6.2.3).
struct MovedThingPayload : map::LandmarkPayload {
  base::LandmarkId landmark;          ///< the retired landmark
  std::string label;                  ///< of the retired landmark: "wall", "marker 7"
  std::vector<ObservedPlace> places;  ///< in the order in which the landmark was first seen there

  std::string_view kind() const override { return "moved thing"; }
  void write(std::ostream& out) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  /// The places as points, with the time when the landmark was last seen at each.
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);
};

}  // namespace omnimapper::plugins
