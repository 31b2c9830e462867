#pragma once

#include <omnimapper/base/Progress.h>

#include <functional>
#include <string>
#include <vector>

#include "Bundle.h"

namespace omnimapper::calibration {

/// A number of a camera, as the report shows it.
struct NumberResult {
  std::string key;       ///< as in [calibration], without "depth_" or "picture_"
  double log, estimate;  ///< in px, m, degrees, or without a unit
  double sigma;          ///< standard deviation; 0 if it was not estimated
};

/// The result of a group of numbers.
struct GroupResult {
  Group group;
  std::vector<NumberResult> numbers;
  bool is_determined = false;  ///< whether the log determines them; else its values hold
  std::string why;             ///< why it does not, with the remedy
};

/// How well the views fit that were held back from the estimate.
struct HeldBack {
  std::size_t corners = 0;
  double pixel_median = 0;  ///< [px]
  double pixel_rms = 0;     ///< [px] of all but the worst tenth
  double depth_rms = 0;     ///< [1/m] of all but the worst tenth
  double cost = 0;          ///< half the mean square of all residuals in standard deviations, with losses
  std::vector<Eigen::Vector2d> pixels, misses;
};

struct Calibration {
  DepthCamera log, estimate;  ///< parameters that are not determined have the same values in both
  std::vector<GroupResult> groups;
  std::size_t views = 0, held_views = 0, tracks = 0, corners = 0, surfaces = 0, spans = 0;
  HeldBack before, after;
  bool is_better = false;  ///< held-back views fit better than before
};

/// Refines a log's calibration of its camera by bundle adjustment over corners and the surfaces of depth images. Throws
/// Error(nothing_to_map), with the remedy, if the views show too little, and Error(interrupted).
Calibration calibrate(const std::vector<CalibrationView>& views, const DepthCamera& log,
                      const std::vector<MetricSpan>& spans, base::Progress& progress,
                      const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
