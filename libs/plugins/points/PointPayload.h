#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <cstdint>
#include <map>
#include <string>

namespace omnimapper::plugins {

/// What the map knows about a point landmark in addition to its position.
struct PointPayload : map::LandmarkPayload {
  std::int32_t number = -1;                      ///< reported by the sensor; -1: none
  double height = 0;                             ///< [m] above the base, the mean of all measurements; for planar maps
  std::map<std::string, std::uint32_t> seen_by;  ///< sensor label: number of measurements

  std::string_view kind() const override { return "point"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  /// "marker 7" with a number, "point" without.
  std::string label() const;
  /// A copy with one more measurement, at this height above the base [m].
  std::shared_ptr<const PointPayload> with(const std::string& sensor_label, double height_of_measurement) const;
  /// A copy with the measurements of another landmark added.
  std::shared_ptr<const PointPayload> with(const PointPayload& other) const;
  std::uint32_t measurements() const;
};

}  // namespace omnimapper::plugins
