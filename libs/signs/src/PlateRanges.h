#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/perception/LensModel.h>
#include <omnimapper/signs/SignDetector.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace omnimapper::signs {

/// A distance and its standard deviation [m].
struct PlateRange {
  double range, sigma;
};

/// What a depth camera measures of the plates that its picture shows.
class PlateRanges {
 public:
  /// `lens`: of the picture. Throws Error(missing_images) for a depth image in a file that was not loaded, and
  /// Error(unreadable_input) for a camera without a calibration.
  PlateRanges(const mrpt::obs::CObservation3DRangeScan& scan, const perception::LensModel& lens);

  /// From the picture's camera to where this ray (unit, its optical frame) meets the plate of these corners [px]. None
  /// where the depth camera sees too little of it, or things at different distances. Noise: perception::DepthNoise.
  std::optional<PlateRange> of(const Corners& plate, const Eigen::Vector3d& ray) const;

 private:
  struct Seen {
    Eigen::Vector2f pixel;  // in the picture
    double depth;           // [m] in the picture's camera
  };
  std::vector<Seen> seen_;
};

}  // namespace omnimapper::signs
