#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// The points of the cloud of a 2D scan in the plane of the base [m], without those that are not finite.
std::vector<Eigen::Vector2f> pointsInBase(const mrpt::obs::CObservationPointCloud& cloud);
/// Projects the cloud of a 2D scan into the plane of the base and fits lines. Points that are not finite are left out.
ScanWithNormals scanInBase(const mrpt::obs::CObservationPointCloud& cloud);
/// As scanInBase(cloud), with numbered things. Its points are those of pointsInBase(cloud), in the same order.
ScanWithNormals scanInBaseWithThings(const mrpt::obs::CObservationPointCloud& cloud);

/// Angle between the plane that a 2D laser scans and the floor, whichever side is up: 0 to pi / 2 [rad].
double tiltOf(const mrpt::poses::CPose3D& base_from_sensor);
/// [rad] Scans that are tilted more do not determine the motion of the base, because they do not see the walls in the
/// plane of the motion.
inline constexpr double kLargestTilt = 10 * base::option_text::kRadiansPerDegree;

/// Motion of the base while a laser turned from its first beam to its last.
struct ScanSweep {
  double aperture;     ///< [rad], symmetric about the sensor's x axis
  bool right_to_left;  ///< direction in which it turned, in the sensor's frame
  mrpt::math::TPose2D begin_from_end;
};

/// As scanInBaseWithThings(cloud), but the scan is deskewed to the middle of the sweep, because an error of the given
/// motion moves it least there. The direction of a point determines when the point was measured.
ScanWithNormals scanInBaseWithThings(const mrpt::obs::CObservationPointCloud& cloud, const ScanSweep& sweep);

}  // namespace omnimapper::matching
