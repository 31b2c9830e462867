#pragma once

#include <omnimapper/plugin/Association.h>

#include <string>

namespace omnimapper::plugins {

struct PointLandmarksOptions : mapper::AssociationOptions {
  std::string label;       ///< empty: every range-bearing sensor
  double sigma_range = 0;  ///< [m] 0: as the observation reports
  double sigma_yaw = 0;    ///< [rad] 0: as the observation reports
  double sigma_pitch = 0;  ///< [rad] 0: as the observation reports
  double loss_scale = 3;   ///< [sigma] of the Huber loss

  static const base::OptionTable<PointLandmarksOptions>& table();
};

}  // namespace omnimapper::plugins
