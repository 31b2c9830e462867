#pragma once

#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

namespace omnimapper::perception::rooms {

/// A flat rectangle, by its middle and two orthogonal half sides [m].
struct Face {
  Eigen::Vector3d middle, half_a, half_b;
};

/// The plane of the face, with a distance of 0 or more.
inline geometry::Plane3 planeOf(const Face& face) {
  const Eigen::Vector3d normal = face.half_a.cross(face.half_b).normalized();
  const auto plane = geometry::Plane3::through(face.middle, normal);
  return plane.distance < 0 ? geometry::Plane3{-plane.normal, -plane.distance} : plane;
}

/// Faces in the optical frame of a camera, and the camera itself.
struct Scene {
  std::vector<Face> faces;
  camera::Pinhole camera;
  int width = 640, height = 480;
};

/// True image of the camera: depth [m] (0: nothing) and index of the face + 1 (0: none) of each pixel.
struct View {
  std::vector<float> depth;
  std::vector<std::uint16_t> face;
};

inline View render(const Scene& scene) {
  const auto pixels = static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  View view{std::vector<float>(pixels, 0.F), std::vector<std::uint16_t>(pixels, 0)};
  const camera::Pinhole& c = scene.camera;
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const Face& face = scene.faces[f];
    const Eigen::Vector3d normal = face.half_a.cross(face.half_b).normalized();
    const double offset = normal.dot(face.middle);
    std::size_t i = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x, ++i) {
        const Eigen::Vector3d ray((x - c.cx) / c.fx, (y - c.cy) / c.fy, 1);
        const double z = offset / normal.dot(ray);
        if (!(z > 0) || (view.face[i] != 0 && z >= view.depth[i])) continue;
        const Eigen::Vector3d from_middle = z * ray - face.middle;
        if (std::abs(from_middle.dot(face.half_a)) > face.half_a.squaredNorm()) continue;
        if (std::abs(from_middle.dot(face.half_b)) > face.half_b.squaredNorm()) continue;
        view.depth[i] = static_cast<float>(z);
        view.face[i] = static_cast<std::uint16_t>(f + 1);
      }
    }
  }
  return view;
}

/// Adds the noise of a triangulating sensor to the depth: white noise averaged over a square window of the correlation
/// area, then rounded to the sensor's steps in inverse depth.
inline std::vector<float> withNoise(const View& view, int width, int height, const camera::DepthNoise& noise,
                                    testing::Dice& dice) {
  const int side = static_cast<int>(std::lround(std::sqrt(noise.correlation)));
  const int wide = width + side - 1, high = height + side - 1;
  std::vector<double> white(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
  for (double& w : white) w = dice.normal(1);
  std::vector<float> noisy(view.depth.size(), 0.F);
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++i) {
      if (view.face[i] == 0) continue;
      double sum = 0;
      for (int v = y; v < y + side; ++v) {
        for (int u = x; u < x + side; ++u) sum += white[static_cast<std::size_t>(v * wide + u)];
      }
      double inverse = 1.0 / view.depth[i] + noise.sigma * sum / side;
      if (noise.step > 0) inverse = noise.step * std::round(inverse / noise.step);
      if (inverse > 0) noisy[i] = static_cast<float>(1 / inverse);
    }
  }
  return noisy;
}

/// A box of the given half sides turned about the vertical, which is the camera's -y before the camera is tilted.
inline void addBox(const Eigen::Isometry3d& camera_from_room, const Eigen::Vector3d& middle,
                   const Eigen::Vector3d& half, double yaw, std::vector<Face>& faces) {
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector3d to_face = side * half[axis] * turned.col(axis);
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      faces.push_back({camera_from_room * (middle + to_face), camera_from_room.linear() * (half[a] * turned.col(a)),
                       camera_from_room.linear() * (half[b] * turned.col(b))});
    }
  }
}

/// A room (z up, floor at 0) with `boxes` pieces of furniture, seen from near one of its corners.
inline Scene randomRoom(testing::Dice& dice, int boxes = 3) {
  Scene scene;
  const double length = dice.uniform(3, 5), width = dice.uniform(3, 4.5), height = dice.uniform(2.3, 2.8);
  // Random numbers are drawn in separate statements, since compilers evaluate arguments in different orders.
  const double z = dice.uniform(0.9, 1.5), y = dice.uniform(0.3, width - 0.3), x = dice.uniform(0.3, 0.8);
  const Eigen::Vector3d camera(x, y, z);
  const double yaw = std::atan2(0.5 * width - camera.y(), 0.6 * length - camera.x()) + dice.uniform(-0.25, 0.25);
  const double down = dice.uniform(0.1, 0.5), roll = dice.uniform(-0.15, 0.15);
  Eigen::Matrix3d forward_left_up =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(down, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Matrix3d room_from_optical;
  room_from_optical << -forward_left_up.col(1), -forward_left_up.col(2), forward_left_up.col(0);
  Eigen::Isometry3d room_from_camera = Eigen::Isometry3d::Identity();
  room_from_camera.linear() = room_from_optical;
  room_from_camera.translation() = camera;
  const Eigen::Isometry3d camera_from_room = room_from_camera.inverse();
  addBox(camera_from_room, {length / 2, width / 2, height / 2}, {length / 2, width / 2, height / 2}, 0, scene.faces);
  for (int i = 0; i < boxes; ++i) {
    const double high = dice.uniform(0.15, 0.5), wide = dice.uniform(0.15, 0.5), deep = dice.uniform(0.15, 0.5);
    const double turn = dice.uniform(-1.5, 1.5);
    const double ahead = dice.uniform(1.7, length - 0.6), aside = dice.uniform(0.6, width - 0.6);
    addBox(camera_from_room, {ahead, aside, high}, {deep, wide, high}, turn, scene.faces);
  }
  return scene;
}

}  // namespace omnimapper::perception::rooms
