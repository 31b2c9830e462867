#pragma once

#include <omnimapper/plugin/Association.h>

#include <string>

namespace omnimapper::plugins {

struct SignLandmarksOptions : mapper::AssociationOptions {
  std::string label;                                                        ///< empty: signs of every camera
  double min_confidence = 0.8;                                              ///< of a line of text that is used
  double pixel_sigma = 0.5 * base::option_text::kRadiansPerDegree;          ///< [rad] of a direction in the camera
  double pan_sigma = 0.5 * base::option_text::kRadiansPerDegree;            ///< [rad] of the camera's reported pan
  double tilt_sigma = 0.5 * base::option_text::kRadiansPerDegree;           ///< [rad] of the camera's reported tilt
  double pan_tilt_offset_sigma = 3 * base::option_text::kRadiansPerDegree;  ///< [rad] of the unit's zero offsets
  double max_sigma = 2;       ///< [m] largest uncertainty of the position of a new sign
  double recent_travel = 10;  ///< [m] distance travelled during which a sign counts as seen recently
  double same_sigma = 0.03;   ///< [m] between two estimates of the centre of one sign
  double loss_scale = 2;      ///< [sigma] of the Cauchy loss

  static const base::OptionTable<SignLandmarksOptions>& table();
};

}  // namespace omnimapper::plugins
