#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/ScanWithNormals.h>

namespace omnimapper::matching {

/// The cloud of a 2D scan in the plane of the base, lines fitted. Points that are not finite are left out.
ScanWithNormals scanInBase(const mrpt::obs::CObservationPointCloud& cloud);

/// Between the plane that a 2D laser scans and the floor, whichever side is up: 0 to pi / 2 [rad].
double tiltOf(const mrpt::poses::CPose3D& base_from_sensor);
/// [rad] Scans that are tilted more do not tell how the base moves: they see walls elsewhere than on the way.
inline constexpr double kLargestTilt = 10 * base::option_text::kRadiansPerDegree;

/// How the base moved while a laser turned from its first beam to its last.
struct ScanSweep {
  double aperture;     ///< [rad], even to both sides of the sensor's x axis
  bool right_to_left;  ///< the way it turned, in the sensor's frame
  mrpt::math::TPose2D begin_from_end;
};

/// The same, as it would look had all beams been taken in the middle of the sweep: there an error of the motion that is
/// told moves the scan least. When a point was measured is told by its direction.
ScanWithNormals scanInBase(const mrpt::obs::CObservationPointCloud& cloud, const ScanSweep& sweep);

}  // namespace omnimapper::matching
