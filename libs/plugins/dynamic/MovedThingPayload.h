#pragma once

#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/PayloadRegistry.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Where a thing was seen for a while.
struct ObservedPlace {
  base::KeyFrameId seen_from;     ///< the last of those it was seen from
  Eigen::Vector3d point_in_base;  ///< [m] its middle, in the base of that one
  base::Stamp first_seen, last_seen;
  std::uint32_t measurements = 0;
};

/// A thing that was moved: the places it was seen at (thesis 4.6.2.3), where it may be looked for.
struct MovedThingPayload : map::LandmarkPayload {
  base::LandmarkId landmark;          ///< that stood for it
  std::string label;                  ///< what it is called
  std::vector<ObservedPlace> places;  ///< in the order it was first seen there

  std::string_view kind() const override { return "moved thing"; }
  void write(std::ostream& out) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  /// The places as points with the times it was last seen there.
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);
};

}  // namespace omnimapper::plugins
