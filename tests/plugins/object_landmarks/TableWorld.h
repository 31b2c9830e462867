#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/obs/CObservationObjects.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "object_landmarks/ObjectModel.h"

// A table with boxes on it, as the depth images of a camera show it, and the boxes as objects without errors.
namespace omnimapper::plugins::table_world {

using Eigen::Vector3d;
using mrpt::obs::CObservation;

/// A box along the axes of the map, which is there from a time to a time [s].
struct Thing {
  Vector3d middle, size;                                             ///< [m]
  double from = 0, until = std::numeric_limits<double>::infinity();  ///< [s]
  bool is_object = true;                                             ///< whether the extractor finds it
  bool isThere(double time) const { return time >= from && time < until; }
};

inline base::Stamp at(double time) {
  return base::stampFromUnix(1'000'000'000 + time);
}

/// The table's top is at 0.7 m.
inline Thing onTable(double x, double y, const Vector3d& size) {
  return {{x, y, 0.7 + 0.5 * size.z()}, size};
}

/// A small camera at a height of 1.3 m that looks to the left of the base and down. Depths in steps of 0.1 mm.
struct TableWorld {
  std::vector<Thing> things;
  mrpt::poses::CPose3D base_from_camera{0, 0, 1.3, EIGEN_PI / 2, 0.45, 0};
  int width = 160, height = 120;
  camera::Pinhole pinhole{140, 140, 79.5, 59.5};

  /// The table, the floor, and a wall behind the table.
  std::vector<Thing> all() const {
    std::vector<Thing> bodies = things;
    for (const auto& [middle, size] : {std::pair(Vector3d(1.5, 1.4, 0.68), Vector3d(5, 1, 0.04)),
                                       {Vector3d(1.5, 1, -0.05), Vector3d(40, 40, 0.1)},
                                       {Vector3d(1.5, 3, 1), Vector3d(40, 0.1, 4)}}) {
      Thing place{middle, size};
      place.is_object = false;
      bodies.push_back(place);
    }
    return bodies;
  }

  struct Hit {
    double depth = 0;  ///< [m] 0: nothing
    int thing = -1;
  };
  Hit castRay(const Vector3d& from, const Vector3d& direction, double time, const std::vector<Thing>& bodies) const {
    Hit hit;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Thing& body = bodies[i];
      if (!body.isThere(time)) continue;
      double enter = 0, leave = std::numeric_limits<double>::infinity();
      const double *origin = from.data(), *along = direction.data();
      const double *middle = body.middle.data(), *size = body.size.data();
      for (int axis = 0; axis < 3 && enter < leave; ++axis) {
        const double gap = middle[axis] - origin[axis], half = 0.5 * size[axis];
        const double a = (gap - half) / along[axis], b = (gap + half) / along[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter > 0 && enter < leave && (hit.depth == 0 || enter < hit.depth)) hit = {enter, static_cast<int>(i)};
    }
    return hit;
  }

  /// The depth image and the objects that it shows by at least 40 pixels.
  std::pair<mrpt::obs::CObservation3DRangeScan::Ptr, obs::CObservationObjects::Ptr> seen(
      const mrpt::poses::CPose3D& map_from_base, double time) const {
    const auto bodies = all();
    const geometry::Se3 base_from_optical = geometry::fromMrpt(base_from_camera) * geometry::sensorFromOptical();
    auto scan = mrpt::obs::CObservation3DRangeScan::Create();
    scan->timestamp = at(time);
    scan->sensorLabel = "kinect";
    scan->sensorPose = base_from_camera;
    scan->hasRangeImage = true;
    scan->range_is_depth = true;
    scan->rangeUnits = 1e-4F;
    scan->rangeImage_setSize(height, width);
    scan->cameraParams.ncols = static_cast<std::uint32_t>(width);
    scan->cameraParams.nrows = static_cast<std::uint32_t>(height);
    scan->cameraParams.setIntrinsicParamsFromValues(pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy);
    const geometry::Se3 map_from_optical = geometry::fromMrpt(map_from_base) * base_from_optical;
    const Eigen::Matrix3d turn = map_from_optical.rotation.toRotationMatrix();
    std::vector<ObjectPoints> points(bodies.size());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vector3d ray = turn * Vector3d((x - pinhole.cx) / pinhole.fx, (y - pinhole.cy) / pinhole.fy, 1);
        const Hit hit = castRay(map_from_optical.translation, ray, time, bodies);
        scan->rangeImage(y, x) = hit.depth > 6 ? 0 : static_cast<std::uint16_t>(std::lround(1e4 * hit.depth));
        if (hit.thing < 0 || !bodies[static_cast<std::size_t>(hit.thing)].is_object) continue;
        const Vector3d in_optical((x - pinhole.cx) / pinhole.fx * hit.depth, (y - pinhole.cy) / pinhole.fy * hit.depth,
                                  hit.depth);
        points[static_cast<std::size_t>(hit.thing)].push_back(camera::toSensor(in_optical).cast<float>());
      }
    }
    auto objects = obs::CObservationObjects::Create();
    objects->timestamp = scan->timestamp;
    objects->sensorLabel = "kinect.objects";
    objects->source_label = "kinect";
    objects->sensorPose = base_from_camera;
    const Vector3d up = geometry::fromMrpt(base_from_camera).rotation.conjugate() * Vector3d::UnitZ();
    for (auto& of_thing : points)
      if (of_thing.size() >= 40) objects->objects.push_back(objectOf(std::move(of_thing), up));
    return {scan, objects};
  }

  static obs::ObservedObject objectOf(ObjectPoints points, const Vector3d& up) {
    obs::ObservedObject object;
    const map::Box box = boxAround(points, up);
    object.sensor_from_box = {box.map_from_box, box.middle};
    object.box_size = box.size;
    for (const auto& point : points) object.centroid += point.cast<double>() / static_cast<double>(points.size());
    object.covariance = 1e-5 * Eigen::Matrix3d::Identity();
    object.supporting_plane = 0;
    object.points = std::move(points);
    return object;
  }
};

/// Where the base is over time [s].
struct Drive {
  double speed = 0.3, length = 3;   ///< [m/s], [m] there and back again, for as long as the log lasts
  double seconds = 10, rate = 2.5;  ///< [s], [Hz] of the camera
  mrpt::poses::CPose2D poseAt(double time) const {
    const double way = std::fmod(speed * time, 2 * length);
    return {way < length ? way : 2 * length - way, 0, 0};
  }
};

/// Wheels without errors and the camera, in the order of their stamps.
inline std::vector<CObservation::Ptr> logOf(const TableWorld& world, const Drive& drive) {
  std::vector<CObservation::Ptr> log;
  for (int i = 0; i <= static_cast<int>(drive.seconds * drive.rate); ++i) {
    const double time = i / drive.rate;
    auto wheels = mrpt::obs::CObservationOdometry::Create();
    wheels->timestamp = at(time);
    wheels->sensorLabel = "odometry";
    wheels->odometry = drive.poseAt(time);
    log.push_back(wheels);
    const auto [scan, objects] = world.seen(mrpt::poses::CPose3D(drive.poseAt(time)), time);
    log.push_back(scan);
    log.push_back(objects);
  }
  return log;
}

}  // namespace omnimapper::plugins::table_world
