#pragma once

#include <omnimapper/base/OptionTable.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

struct LoopClosureOptions {
  std::vector<std::string> labels;  ///< of the clouds; empty: all clouds made from 2D scans
  double radius = 4.0;              ///< [m]
  double min_travel = 8.0;          ///< [m]
  double spacing = 1.5;             ///< [m]
  int candidates = 2;
  double context = 2.0;                                                   ///< [m]
  double max_window = 15.0;                                               ///< [m]
  double max_window_angle = 60.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double lost_travel = 15.0;                                              ///< [m]
  double join_travel = 15.0;                                              ///< [m]
  double known_sigma = 0.05;                                              ///< [m]
  double known_angle_sigma = 1.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double min_overlap = 0.75;
  double max_sigma = 0.06;    ///< [m]
  double point_sigma = 0.05;  ///< [m]
  double wall_sigma_factor = 4;
  double position_sigma_floor = 0.03;                                     ///< [m]
  double angle_sigma_floor = 0.5 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double loss_scale = 2.0;                                                ///< [sigma] of the Cauchy loss

  static const base::OptionTable<LoopClosureOptions>& table();
};

}  // namespace omnimapper::plugins
