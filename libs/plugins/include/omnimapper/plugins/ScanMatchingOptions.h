#pragma once

#include <omnimapper/base/OptionTable.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

struct ScanMatchingOptions {
  std::vector<std::string> labels;  ///< of the clouds; empty: every cloud made from a 2D scan
  int local_frames = 8;
  double min_overlap = 0.6;
  double max_correction = 0.5;                                               ///< [m]
  double max_turn_correction = 20.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double point_sigma = 0.05;                                                 ///< [m]
  double wall_sigma_factor = 4;
  double position_sigma_floor = 0.01;                                     ///< [m]
  double angle_sigma_floor = 0.2 * base::option_text::kRadiansPerDegree;  ///< [rad]

  bool close_loops = true;
  double loop_radius = 6.0;   ///< [m]
  double loop_min_way = 8.0;  ///< [m]
  int loop_frames = 4;
  int loop_candidates = 2;
  double loop_min_overlap = 0.75;
  double loop_max_distance = 2.0;                                                 ///< [m]
  double loop_max_correction = 4.0;                                               ///< [m]
  double loop_max_turn_correction = 30.0 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double loop_position_sigma_floor = 0.03;                                        ///< [m]
  double loop_angle_sigma_floor = 0.5 * base::option_text::kRadiansPerDegree;     ///< [rad]
  double loop_loss_scale = 2.0;                                                   ///< [sigma] of the Cauchy loss

  static const base::OptionTable<ScanMatchingOptions>& table();
};

}  // namespace omnimapper::plugins
