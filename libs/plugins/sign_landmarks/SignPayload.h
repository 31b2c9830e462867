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

/// How one image shows a sign.
struct SignLook {
  base::KeyFrameId frame;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, from the camera to the sign, in the base
  double area_px = 0;                                    ///< [px^2] of its region in the image
  std::shared_ptr<const map::Photograph> photograph;     ///< of the sign alone; null if there is none
};

/// What the map knows about a sign in addition to its position.
struct SignPayload : map::LandmarkPayload {
  std::map<std::string, double> numbers;         ///< each number that was read, with the sum of its confidences
  std::map<std::string, double> words;           ///< the same for the other lines of text
  bool is_repeated = false;                      ///< another sign elsewhere has the same text
  std::map<std::string, std::uint32_t> seen_by;  ///< sensor label: number of measurements
  std::optional<SignLook> best_look;             ///< the look with the largest area; none in maps of older versions

  std::string_view kind() const override { return "door_sign"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  /// The number with the largest sum of confidences, and the words whose sum is at least half of the largest sum of a
  /// word.
  SignText text() const;
  /// The number, such as "213", or the words if there is no number.
  std::string title() const;
  std::uint32_t measurements() const;

  std::shared_ptr<SignPayload> with(const SignText& text, const std::string& sensor_label) const;
  /// A copy with the measurements of another sign added.
  std::shared_ptr<SignPayload> with(const SignPayload& other) const;
  std::shared_ptr<SignPayload> repeated() const;
  bool isBetter(double area_px) const { return !best_look || area_px > best_look->area_px; }
};

}  // namespace omnimapper::plugins
