#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/camera/LensModel.h>
#include <omnimapper/signs/SignDetector.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace omnimapper::signs {

/// A distance and its standard deviation [m].
struct PlateRange {
  double range, sigma;
};

/// Distances of plates in a picture, measured by the depth image of the same observation.
class PlateRanges {
 public:
  /// `lens` is that of the picture. Throws Error(missing_images) for a depth image in a file that was not loaded, and
  /// Error(unreadable_input) for a camera without a calibration.
  PlateRanges(const mrpt::obs::CObservation3DRangeScan& scan, const camera::LensModel& lens);

  /// Distance from the picture's camera along this ray (unit vector in its optical frame) to the plate with these
  /// corners [px]. None if the depth image has too few pixels of it, or their distances differ too much. The noise is
  /// that of camera::DepthNoise.
  std::optional<PlateRange> of(const Corners& plate, const Eigen::Vector3d& ray) const;

 private:
  struct DepthPixel {
    Eigen::Vector2f pixel;  // position in the picture
    double depth;           // [m] in the frame of the picture's camera
  };
  std::vector<DepthPixel> depth_pixels_;
};

}  // namespace omnimapper::signs
