#pragma once

#include <omnimapper/geometry/Segment2.h>
#include <omnimapper/obs/CDerivedObservation.h>

#include <vector>

namespace omnimapper::obs {

/// Why a line ends where it does. The values are stored in rawlogs and must not change.
enum class LineEnd : std::uint8_t {
  wall = 0,      ///< the wall ends: the next beam meets something behind it, or a wall that joins it at a corner
  occluded = 1,  ///< something nearer hides the rest of the wall
  view = 2       ///< the scan ends, or the next beam met nothing
};

/// A straight segment in a 2D laser scan.
struct LaserLine {
  geometry::Segment2 segment_in_sensor;  ///< [m] in the plane of the scan (z = 0), from the first beam to the last
  /// The line: x cos(angle) + y sin(angle) = distance. The angle [rad], in (-pi, pi], is the direction from the sensor
  /// to the line's nearest point; distance [m] >= 0. The same line as a geometry::Plane3 has the
  /// normal -(cos(angle), sin(angle), 0) and the distance `distance`.
  double angle = 0;
  double distance = 0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (angle [rad], distance [m])
  LineEnd from_end = LineEnd::wall;
  LineEnd to_end = LineEnd::wall;
  std::uint32_t first_beam = 0;  ///< index in the scan
  std::uint32_t last_beam = 0;   ///< inclusive
  std::uint32_t inliers = 0;     ///< number of beams from first_beam to last_beam that lie on the line
  double rms = 0;                ///< [m] root mean square distance of the points of these beams from the line
};

/// The straight lines of one 2D laser scan, in the order of its beams.
class CObservationLaserLines : public CDerivedObservation {
  DEFINE_SERIALIZABLE(CObservationLaserLines, omnimapper::obs)

 public:
  std::vector<LaserLine> lines;

  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;

 protected:
  void describe(std::ostream& out) const override;
  /// Draws thick segments in a colour by index. A cross bar marks an end of the wall; a ball marks any other end, black
  /// if the rest of the wall is hidden, white if the view ends.
  void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const override;
};

}  // namespace omnimapper::obs
