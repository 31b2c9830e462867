#pragma once

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::geometry {

/// Tells which points of a 2D scan lie on the floor, the plane z = 0 of the base, so that they show no wall. A laser
/// meets the floor if it is tilted. Nothing is on the floor if the pose declares neither a tilt nor a height: lasers
/// whose height is not known are often declared at z = 0.
class FloorHits {
 public:
  explicit FloorHits(const mrpt::poses::CPose3D& base_from_sensor) : height_(base_from_sensor.z()) {
    constexpr double kLeastHeight = 0.1, kLeastSlope = 0.01;  // [m] [-] half a degree
    const auto& rotation = base_from_sensor.getRotationMatrix();
    slope_x_ = rotation(2, 0), slope_y_ = rotation(2, 1);
    is_tilted_ = height_ > kLeastHeight && std::hypot(slope_x_, slope_y_) > kLeastSlope;
    // The floor is not flat to a centimetre, and a tilt is declared to some tenths of a degree.
    constexpr double kShare = 0.2, kLeast = 0.05;  // of the height, [m]
    limit_ = std::max(kLeast, kShare * height_);
  }

  bool arePossible() const { return is_tilted_; }
  /// Whether a point of the scan, in the frame of the sensor [m], lies on the floor.
  bool holds(double x, double y) const { return is_tilted_ && height_ + slope_x_ * x + slope_y_ * y < limit_; }

 private:
  double height_, slope_x_ = 0, slope_y_ = 0, limit_ = 0;
  bool is_tilted_ = false;
};

}  // namespace omnimapper::geometry
