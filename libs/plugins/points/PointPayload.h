#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <cstdint>
#include <map>
#include <string>

namespace omnimapper::plugins {

/// What is known of a point landmark beside where it is.
struct PointPayload : map::LandmarkPayload {
  std::int32_t number = -1;                      ///< that the sensor tells; -1: none
  double height = 0;                             ///< [m] above the base, mean of the sightings: a planar map has none
  std::map<std::string, std::uint32_t> seen_by;  ///< sensor label: sightings

  std::string_view kind() const override { return "point"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  /// "marker 7", "point".
  std::string label() const;
  /// With one more sighting, so high above the base.
  std::shared_ptr<const PointPayload> with(const std::string& sensor_label, double height_of_sighting) const;
  /// With the sightings of another.
  std::shared_ptr<const PointPayload> with(const PointPayload& other) const;
  std::uint32_t sightings() const;
};

}  // namespace omnimapper::plugins
