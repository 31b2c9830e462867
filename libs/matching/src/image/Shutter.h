#pragma once

#include <omnimapper/matching/DenseMatcher.h>

#include <Eigen/Geometry>

namespace omnimapper::matching {

/// Times at which the rows of an image were taken, and the effect of the camera's motion, to first order: a point at p
/// in the camera's frame at the middle of the depths is at p - after (v + w x p) when `after` seconds have passed.
class Shutter {
 public:
  Shutter(const CameraMotion& motion, double delay, double readout)
      : linear_(motion.velocity.head<3>()), turn_(motion.velocity.tail<3>()), delay_(delay), readout_(readout) {}

  /// Time of a row [s] after the middle of the depths.
  double after(double row, int height) const { return delay_ + readout_ * ((row + 0.5) / height - 0.5); }
  double delay() const { return delay_; }
  double readout() const { return readout_; }
  const Eigen::Vector3d& linear() const { return linear_; }
  const Eigen::Vector3d& turn() const { return turn_; }

  /// A point that was measured `after` seconds later, at the middle of the depths.
  Eigen::Vector3d back(const Eigen::Vector3d& p, double after) const { return p + after * (linear_ + turn_.cross(p)); }
  Eigen::Vector3d turnedBack(const Eigen::Vector3d& n, double after) const {
    return (n + after * turn_.cross(n)).normalized();
  }
  /// Where a point is when the row is taken that shows it.
  Eigen::Vector3d seen(const Eigen::Vector3d& p, const RgbdLevel& level) const {
    const double row = level.camera.fy * p.y() / std::max(0.05, p.z()) + level.camera.cy;
    const double when = after(std::clamp(row, 0.0, static_cast<double>(level.height)), level.height);
    return p - when * (linear_ + turn_.cross(p));
  }

 private:
  Eigen::Vector3d linear_, turn_;
  double delay_, readout_;
};

}  // namespace omnimapper::matching
