#pragma once

#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <random>
#include <string>

namespace omnimapper::obs {

/// Objects of each class with every field off its default: a small scene that a person can look at, too.

using Engine = std::mt19937_64;

inline double drawn(Engine& engine, double low = -1, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}

template <int size>
Eigen::Matrix<double, size, size> drawnCovariance(Engine& engine, double deviation) {
  Eigen::Matrix<double, size, size> root;
  for (auto& value : root.reshaped()) value = deviation * drawn(engine);
  return root * root.transpose() + deviation * deviation * Eigen::Matrix<double, size, size>::Identity();
}

template <class Observation>
std::shared_ptr<Observation> withHead(const std::string& source, const std::string& suffix) {
  auto observation = Observation::Create();
  observation->timestamp = base::parseUnix("1137834225.9737601");
  observation->sensorLabel = source + suffix;
  observation->source_label = source;
  observation->sensorPose = mrpt::poses::CPose3D(0.1, -1.0 / 3.0, 0.9, 0.3, 0.2, 0.1);
  return observation;
}

inline std::shared_ptr<CObservationRelativeMotion> filledMotion() {
  Engine engine(7);
  auto motion = CObservationRelativeMotion::Create();
  motion->timestamp = base::parseUnix("1137834225.9737601");
  motion->begin = base::parseUnix("1137834225.8737603");
  motion->sensorLabel = "visual odometry";
  const mrpt::poses::CPose3D pose(0.1, -1.0 / 3.0, 1e-17, 3.0, -1.5, 0.7);
  // MRPT keeps angles beside the matrix, and a pose that is read has the angles of the matrix, to the last bit.
  motion->begin_from_end = mrpt::poses::CPose3D(pose.getRotationMatrix(), pose.m_coords);
  for (auto& value : motion->covariance.reshaped()) value = drawn(engine);
  return motion;
}

/// A floor with a square hole and an L-shaped wall on it, seen by a sensor above the floor.
inline std::shared_ptr<CObservationPlanes> filledPlanes() {
  Engine engine(3);
  auto planes = withHead<CObservationPlanes>("camera", ".planes");
  ObservedPlane floor;
  floor.plane_in_sensor = {Eigen::Vector3d::UnitZ(), 0.9};
  floor.covariance = drawnCovariance<3>(engine, 2e-3);
  floor.centroid = {2.5, 0, -0.9};
  floor.outline = {{{1, -1.5, -0.9}, {4, -1.5, -0.9}, {4, 1.5, -0.9}, {1, 1.5, -0.9}}};
  floor.holes = {{{{2, -0.5, -0.9}, {2, 0.5, -0.9}, {3, 0.5, -0.9}, {3, -0.5, -0.9}}}};
  floor.inliers = 120000;
  floor.rms = 0.004;
  floor.roughness = 1.25;
  floor.colour = Rgb{120, 110, 90};
  ObservedPlane wall;
  wall.plane_in_sensor = {-Eigen::Vector3d::UnitX(), 4};
  wall.covariance = drawnCovariance<3>(engine, 3e-3);
  wall.centroid = {4, 0, 0.2};
  wall.outline = {{{4, -1.5, -0.9}, {4, 1.5, -0.9}, {4, 1.5, 0.2}, {4, 0.3, 0.2}, {4, 0.3, 1.3}, {4, -1.5, 1.3}}};
  wall.inliers = 54321;
  wall.rms = 0.012;
  planes->planes = {floor, wall};
  return planes;
}

/// A wall that is partly hidden, and its neighbour, which extends beyond the view of the scan.
inline std::shared_ptr<CObservationLaserLines> filledLines() {
  Engine engine(4);
  auto lines = withHead<CObservationLaserLines>("laser", ".lines");
  LaserLine ahead;
  ahead.segment_in_sensor = {{3, -2}, {3, 1}};
  ahead.angle = 1e-9;
  ahead.distance = 3;
  ahead.covariance = drawnCovariance<2>(engine, 2e-3);
  ahead.from_end = LineEnd::occluded;
  ahead.to_end = LineEnd::wall;
  ahead.first_beam = 40;
  ahead.last_beam = 110;
  ahead.inliers = 69;
  ahead.rms = 0.011;
  LaserLine left = ahead;
  left.segment_in_sensor = {{3, 1}, {-1, 1}};
  left.angle = 1.5707963;
  left.distance = 1;
  left.from_end = LineEnd::wall;
  left.to_end = LineEnd::view;
  left.first_beam = 111;
  left.last_beam = 180;
  lines->lines = {ahead, left};
  return lines;
}

/// A box with coloured points and a label, and an object without colour, label and supporting plane.
inline std::shared_ptr<CObservationObjects> filledDetections() {
  Engine engine(5);
  auto objects = withHead<CObservationObjects>("camera", ".objects");
  ObservedObject mug;
  mug.centroid = {1.5, 0.2, -0.1};
  mug.covariance = drawnCovariance<3>(engine, 0.004);
  mug.sensor_from_box.rotation = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ());
  mug.sensor_from_box.translation = {1.5, 0.2, -0.1};
  mug.box_size = {0.3, 0.2, 0.25};
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d in_box(drawn(engine, -0.15, 0.15), drawn(engine, -0.1, 0.1), drawn(engine, -0.12, 0.12));
    mug.points.push_back((mug.sensor_from_box * in_box).cast<float>());
    mug.colours.push_back({static_cast<std::uint8_t>(200 + i % 50), 30, 40});
  }
  mug.supporting_plane = 1;
  mug.colour = Rgb{220, 30, 40};
  mug.class_label = "coffee mug";
  mug.score = 0.83;
  ObservedObject unknown = mug;
  unknown.sensor_from_box.translation.y() -= 0.6;
  unknown.centroid.y() -= 0.6;
  for (auto& point : unknown.points) point.y() -= 0.6F;
  unknown.points.resize(40);
  unknown.colours.clear();
  unknown.supporting_plane.reset();
  unknown.colour.reset();
  unknown.class_label.clear();
  objects->objects = {mug, unknown};
  return objects;
}

/// Signs seen by a camera that looks along the base's x: one with two lines of text and a patch, and one far away.
inline std::shared_ptr<CObservationDoorSigns> filledSigns() {
  auto signs = withHead<CObservationDoorSigns>("camera", ".signs");
  signs->sensorPose = mrpt::poses::CPose3D(0.1, 0, 1.2, -1.5707963267948966, 0, -1.5707963267948966);
  ObservedDoorSign sign;
  sign.corners_px = {Eigen::Vector2f(300, 200), {340.5F, 201}, {340, 226.25F}, {299, 225}};
  sign.ray = Eigen::Vector3d(-0.1, 0.05, 1).normalized();
  sign.range = 1.5;
  sign.range_sigma = 0.05;
  sign.score = 0.97;
  sign.texts = {{"Room 241", 0.9}, {"B\xC3\xBCro", 0.55}};
  sign.patch = mrpt::img::CImage(24, 16, mrpt::img::CH_RGB);
  for (unsigned y = 0; y < 16; ++y) {
    for (unsigned x = 0; x < 24; ++x) {
      // White with a dark red bar along the top and a dark stroke at the left, so that one sees how it is turned.
      const bool bar = y < 4, stroke = x < 4 && y >= 4;
      auto* pixel = sign.patch.ptrLine<std::uint8_t>(y) + 3 * x;
      pixel[0] = pixel[1] = bar || stroke ? 20 : 250;
      pixel[2] = bar ? 200 : stroke ? 20 : 250;
    }
  }
  ObservedDoorSign far;
  far.ray = Eigen::Vector3d(0.3, 0, 1).normalized();
  far.is_cut = true;
  far.patch = mrpt::img::CImage(5, 4, mrpt::img::CH_GRAY);
  for (unsigned y = 0; y < 4; ++y)
    for (unsigned x = 0; x < 5; ++x) far.patch.ptrLine<std::uint8_t>(y)[x] = static_cast<std::uint8_t>(40 * x + y);
  signs->signs = {sign, far};
  return signs;
}

inline std::shared_ptr<CObservationCommand> filledCommand() {
  auto command = CObservationCommand::Create();
  command->timestamp = base::parseUnix("1137834225.9737601");
  command->sensorLabel = "page";
  command->kind = CommandKind::label;
  command->subject = CommandSubject::object;
  command->text =
      "K\xC3\xBC"
      "chen tisch";
  command->origin = "anna";
  command->expiry = 30;
  command->motion = {0.5, -1.0 / 3.0, 0.1};
  return command;
}

inline std::map<std::string, std::function<mrpt::serialization::CSerializable::Ptr()>> filledObjects() {
  return {{"omnimapper::obs::CObservationRelativeMotion", filledMotion},
          {"omnimapper::obs::CObservationPlanes", filledPlanes},
          {"omnimapper::obs::CObservationLaserLines", filledLines},
          {"omnimapper::obs::CObservationObjects", filledDetections},
          {"omnimapper::obs::CObservationDoorSigns", filledSigns},
          {"omnimapper::obs::CObservationCommand", filledCommand}};
}

}  // namespace omnimapper::obs
