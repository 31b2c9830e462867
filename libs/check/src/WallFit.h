#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Plane3.h>

#include <Eigen/Core>
#include <vector>

#include "CameraFit.h"

namespace omnimapper::check {

struct CameraPlane {
  geometry::Plane3 plane;  // in the frame of the sensor
  double angle_sigma;      // [rad] of its normal
};

struct View {
  base::Stamp stamp;
  std::vector<CameraPlane> planes;
};

constexpr std::size_t kFewestWalls = 6;  ///< of a camera that must lie on walls of the laser

/// Finds with which yaw, scale, focal length and clock the upright planes of a camera lie on the walls of a laser.
class WallFit {
 public:
  /// `level_from_sensor`: rotation of the camera at the declared yaw, once the floor is level. `position` [m] of the
  /// camera on the base. `views` and `witness` must outlive this.
  WallFit(const std::vector<View>& views, const CameraWitness& witness, const Eigen::Matrix3d& level_from_sensor,
          const Eigen::Vector3d& position);

  /// Number of upright planes.
  std::size_t size() const { return walls_.size(); }
  /// Sets the members of `facts` from `matched` to `clock`. All but `matched` stay unset if too few planes agree.
  void measure(CameraFacts& facts) const;

 private:
  // An upright plane of the camera, as a wall seen from the declared place of the sensor.
  struct CameraWall {
    std::size_t view;
    double azimuth;   // [rad] in the base, once the floor is level
    double bearing;   // [rad] azimuth relative to the optical axis
    double distance;  // [m] from the sensor
    double sigma;     // [rad] of the azimuth
  };
  struct Match {
    const CameraWall* wall;
    BaseWall laser;
  };
  struct Vote {
    double yaw = 0, log_scale = 0;
    std::size_t planes = 0;  // that have a wall there
  };

  std::vector<std::vector<BaseWall>> lasersAt(double clock) const;
  double distanceOf(const BaseWall& laser) const;
  std::pair<double, double> pairing(const CameraWall& wall, const BaseWall& laser) const;
  Vote vote(double clock) const;
  std::vector<Match> matches(double yaw, double log_scale, double clock, double focal_slope) const;
  std::size_t refine(const Vote& start, double clock, CameraFacts& facts) const;

  const std::vector<View>& views_;
  const CameraWitness& witness_;
  Eigen::Vector3d position_;
  std::vector<CameraWall> walls_;
};

}  // namespace omnimapper::check
