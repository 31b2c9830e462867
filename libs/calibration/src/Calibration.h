#pragma once

#include <omnimapper/base/Progress.h>

#include <functional>
#include <string>
#include <vector>

#include "Bundle.h"

namespace omnimapper::calibration {

/// One number of a camera, as a user meets it.
struct Figure {
  std::string key;       ///< as [calibration] has it, without "depth_" or "picture_"
  double log, estimate;  ///< px, m, degrees, or no unit
  double sigma;          ///< standard deviation; that of the weak prior where nothing was estimated
};

/// What became of some numbers that belong together.
struct Finding {
  Group group;
  std::vector<Figure> metrics;
  bool is_determined = false;  ///< by the log; else the log's values hold
  std::string why;             ///< it is not; a sentence with the remedy
};

/// How well held-back views fit, which had no part in the estimate.
struct HeldBack {
  std::size_t corners = 0;
  double pixel_median = 0;  ///< [px]
  double pixel_rms = 0;     ///< [px] of all but the worst tenth
  double depth_rms = 0;     ///< [1/m] of all but the worst tenth
  double cost = 0;          ///< half the mean square of all residuals in standard deviations, with losses
  std::vector<Eigen::Vector2d> pixels, misses;
};

struct Calibration {
  DepthCamera log, estimate;  ///< what is not determined is in `estimate` as in `log`
  std::vector<Finding> findings;
  std::size_t views = 0, held_views = 0, tracks = 0, corners = 0, surfaces = 0, spans = 0;
  HeldBack before, after;
  bool is_better = false;  ///< held-back views fit better
};

/// Refines what a log says of its camera by bundle adjustment over corners and the surfaces of depth images. Throws
/// Error(nothing_to_map), with the remedy, where too little was seen, and Error(interrupted).
Calibration calibrate(const std::vector<CalibrationView>& views, const DepthCamera& log,
                      const std::vector<MetricSpan>& spans, base::Progress& progress,
                      const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
