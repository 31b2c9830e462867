#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "SignText.h"

namespace omnimapper::plugins {

/// A sign as an image shows it.
struct SignLook {
  base::KeyFrameId frame;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, from the camera to the sign, in the base
  double area_px = 0;                                    ///< [px^2] of its region in the image
  std::shared_ptr<const map::Photograph> photograph;     ///< of the sign alone; null for none
};

/// What is known of a sign beside where it is.
struct SignPayload : map::LandmarkPayload {
  std::map<std::string, double> numbers;         ///< as they were read, with the sum of their confidences
  std::map<std::string, double> words;           ///< the same of the other lines
  bool is_repeated = false;                      ///< another sign elsewhere says the same
  std::map<std::string, std::uint32_t> seen_by;  ///< sensor label: sightings
  std::optional<SignLook> best_look;             ///< the largest; none in maps from before it was kept

  std::string_view kind() const override { return "door_sign"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  /// The number that was read most, and words with at least half the votes of the most frequent.
  SignText text() const;
  /// "213", or the words where there is no number.
  std::string title() const;
  std::uint32_t sightings() const;

  std::shared_ptr<SignPayload> with(const SignText& text, const std::string& sensor_label) const;
  /// With the sightings of another.
  std::shared_ptr<SignPayload> with(const SignPayload& other) const;
  std::shared_ptr<SignPayload> repeated() const;
  bool isBetter(double area_px) const { return !best_look || area_px > best_look->area_px; }
};

}  // namespace omnimapper::plugins
