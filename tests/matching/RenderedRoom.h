#pragma once

#include <omnimapper/matching/RgbdTracker.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace omnimapper::matching {

/// A pose by its tangent, as in geometry::Se3: [m] and [rad].
inline geometry::Se3 posed(double x, double y, double z, double turn_x, double turn_y, double turn_z) {
  geometry::Vector6d delta;
  delta << x, y, z, turn_x, turn_y, turn_z;
  return geometry::plus(geometry::Se3{}, delta);
}

/// A camera in an empty room of 4 x 3 x 2.5 m whose walls have a smooth pattern: depths and brightness without
/// discontinuities.
struct RenderedRoom {
  double half[3] = {2, 1.25, 1.5};  ///< [m] from the middle to the walls
  int width = 320, height = 240;
  camera::Pinhole camera{260, 260, 159.5, 119.5};
  double depth_noise = 0;  ///< [1/m] of the inverse depth
  double grey_noise = 0;
  double gain = 1, offset = 0;
  bool only_far_wall = false;
  unsigned tiles = 0;  ///< number of the set of grey and black tiles on the walls, so that there are corners; 0: none

  struct Image {
    std::vector<float> depth;
    std::vector<std::uint8_t> grey;
  };

  /// Renders the room, with a pose of the camera for each row of the depths and of the picture.
  Image render(const std::function<geometry::Se3(int row)>& of_depth,
               const std::function<geometry::Se3(int row)>& of_grey, std::uint64_t seed = 1) const {
    testing::Dice dice(seed);
    Image image;
    for (int y = 0; y < height; ++y) {
      const Pose depth_pose(of_depth(y)), grey_pose(of_grey(y));
      for (int x = 0; x < width; ++x) {
        const double across = (x - camera.cx) / camera.fx, down = (y - camera.cy) / camera.fy;
        const double inverse = 1 / depthOf(depth_pose, across, down) + (depth_noise > 0 ? dice.normal(depth_noise) : 0);
        image.depth.push_back(static_cast<float>(1 / inverse));
        const double grey =
            gain * patternAt(grey_pose, across, down) + offset + (grey_noise > 0 ? dice.normal(grey_noise) : 0);
        image.grey.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0))));
      }
    }
    return image;
  }
  Image render(const geometry::Se3& pose, std::uint64_t seed = 1) const {
    const auto still = [&](int) { return pose; };
    return render(still, still, seed);
  }

  camera::DepthImage depthImage(const Image& image) const { return {image.depth.data(), width, height, camera}; }
  RgbdPyramid pyramid(const Image& image, bool with_picture = true) const {
    const camera::ColourImage colour{image.grey.data(), width, height, width, camera::ColourImage::Order::grey};
    return {depthImage(image), with_picture ? &colour : nullptr};
  }

 private:
  // Computes with plain numbers, because tests are not optimized.
  struct Pose {
    explicit Pose(const geometry::Se3& pose) {
      const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
      for (int i = 0; i < 3; ++i) {
        at[i] = pose.translation[i];
        for (int j = 0; j < 3; ++j) turn[i][j] = r(i, j);
      }
    }
    double along(int axis, double across, double down) const {
      return turn[axis][0] * across + turn[axis][1] * down + turn[axis][2];
    }
    double at[3], turn[3][3];
  };

  double depthOf(const Pose& pose, double across, double down) const {
    double nearest = 100;
    for (int axis = only_far_wall ? 2 : 0; axis < 3; ++axis) {
      const double direction = pose.along(axis, across, down);
      if (direction == 0) continue;
      const double depth = ((direction > 0 ? half[axis] : -half[axis]) - pose.at[axis]) / direction;
      if (depth > 0 && depth < nearest) nearest = depth;
    }
    return nearest;
  }

  double tileAt(const double (&p)[3]) const {
    if (tiles == 0) return 0;
    std::uint64_t number = tiles;
    for (const double one : p) {
      constexpr double kSide = 0.07, kOnTheWall = 1e-6;  // [m]
      number = 6364136223846793005U *
               (number +
                static_cast<std::uint64_t>(std::lround(std::floor(one / kSide + 0.37 * tiles + kOnTheWall)) + 1000));
      number ^= number >> 29;
    }
    return number % 2 == 0 ? 0 : -45;
  }

  double patternAt(const Pose& pose, double across, double down) const {
    const double depth = depthOf(pose, across, down);
    double p[3];
    for (int axis = 0; axis < 3; ++axis) p[axis] = pose.at[axis] + depth * pose.along(axis, across, down);
    return tileAt(p) + 128 + 30 * std::sin(7 * p[0] + 3 * p[2]) + 30 * std::sin(9 * p[1] - 5 * p[0]) +
           20 * std::sin(13 * p[2] + 4 * p[1]);
  }
};

}  // namespace omnimapper::matching
