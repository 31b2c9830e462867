#pragma once

#include "DepthRooms.h"

namespace omnimapper::perception::rooms {

/// A table of 1.2 x 0.8 m, 0.7 m high, before a wall, and a camera 1 m before its middle that looks down on it by 35
/// degrees. Room: x away from the camera, y left, z up, the origin on the floor below the camera.
struct TableScene {
  Scene scene;
  Eigen::Isometry3d room_from_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3d up;  ///< in the optical frame

  TableScene() {
    const double down = 35 * M_PI / 180;
    Eigen::Matrix3d room_from_optical;
    room_from_optical << 0, -std::sin(down), std::cos(down),  //
        -1, 0, 0,                                             //
        0, -std::cos(down), -std::sin(down);
    room_from_camera.linear() = room_from_optical;
    room_from_camera.translation() = Eigen::Vector3d(0, 0, 1.4);
    up = room_from_optical.transpose() * Eigen::Vector3d::UnitZ();
    addBlock({0, 0, -0.01}, {10, 10, 0.02});   // floor
    addBlock({1, 0, 0.69}, {0.8, 1.2, 0.02});  // table top
    addBlock({2.01, 0, 1}, {0.02, 10, 2.5});   // wall
  }
  /// Adds a block with this middle and these whole sides [m], turned about the vertical.
  void addBlock(const Eigen::Vector3d& middle, const Eigen::Vector3d& size, double yaw = 0) {
    addBox(room_from_camera.inverse(), middle, 0.5 * size, yaw, scene.faces);
  }
};

}  // namespace omnimapper::perception::rooms
