#include "ObjectMeasurement.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace omnimapper::plugins {

namespace {

constexpr double kFarthestObject = 100;  // [m] no camera finds objects farther away

std::string whyUselessObject(const obs::ObservedObject& object) {
  const auto& box = object.sensor_from_box;
  const auto isNear = [](const auto& point) {
    return point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthestObject;
  };
  if (!isNear(box.translation) || !(object.box_size.minCoeff() > 0) || !isNear(object.box_size))
    return "it has no place or no size";
  if (!(std::abs(box.rotation.norm() - 1) < 1e-3)) return "its box has no axes";
  if (object.points.empty()) return "it has no points";
  if (!std::all_of(object.points.begin(), object.points.end(), isNear)) return "it has points that are not finite";
  const Eigen::Matrix3d& covariance = object.covariance;
  if (!covariance.allFinite() || covariance.llt().info() != Eigen::Success)
    return "its covariance is not positive definite";
  return "";
}

// The points in the base, those of an object that was told apart from the surface on which it stands.
ObjectView viewOf(const obs::ObservedObject& object, const geometry::Se3& base_from_sensor, base::KeyFrameId frame) {
  ObjectView view;
  view.frame = frame;
  const geometry::Se3 base_from_box = base_from_sensor * object.sensor_from_box;
  if (object.supporting_plane) {
    view.up = base_from_box.rotation * Eigen::Vector3d::UnitZ();
    view.foot = base_from_box * Eigen::Vector3d(0, 0, -0.5 * object.box_size.z());
  }
  const Eigen::Matrix3f turn = base_from_sensor.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f move = base_from_sensor.translation.cast<float>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : object.points) {
    view.points.emplace_back(turn * point + move);
    sum += point.cast<double>();
  }
  view.distance = (sum / static_cast<double>(object.points.size())).norm();
  if (object.colours.size() == object.points.size()) view.colours = object.colours;
  return view;
}

}  // namespace

Eigen::Matrix3d covarianceOfPart(const Eigen::Matrix3d& axes, const Eigen::Vector3d& size, double share) {
  return axes * (share * size).cwiseAbs2().asDiagonal() * axes.transpose();
}

std::vector<ObjectMeasurement> objectMeasurements(const obs::CObservationObjects& observation, base::KeyFrameId frame,
                                                  const std::vector<std::optional<ObjectPicture>>& pictures,
                                                  const ObjectLandmarksOptions& options, std::size_t& dropped) {
  const geometry::Se3 base_from_sensor = geometry::fromMrpt(observation.sensorPose);
  const auto& objects = observation.objects;
  std::vector<std::size_t> order(objects.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return objects[a].points.size() > objects[b].points.size(); });
  const auto most = static_cast<std::size_t>(options.max_per_image);
  dropped = order.size() > most ? order.size() - most : 0;
  order.resize(order.size() - dropped);
  std::vector<ObjectMeasurement> measurements;
  for (const std::size_t i : order) {
    const auto& object = objects[i];
    ObjectMeasurement& measurement = measurements.emplace_back();
    measurement.sensor_label = observation.source_label.empty() ? observation.sensorLabel : observation.source_label;
    measurement.why_useless = whyUselessObject(object);
    if (!measurement.why_useless.empty()) continue;
    measurement.view = viewOf(object, base_from_sensor, frame);
    const geometry::Se3 base_from_box = base_from_sensor * object.sensor_from_box;
    measurement.middle = base_from_box.translation;
    measurement.size = object.box_size;
    const Eigen::Matrix3d turn = base_from_sensor.rotation.toRotationMatrix();
    measurement.covariance =
        turn * object.covariance * turn.transpose() +
        covarianceOfPart(base_from_box.rotation.toRotationMatrix(), object.box_size, options.size_share);
    measurement.class_label = base::printable(object.class_label);
    measurement.score = std::isfinite(object.score) ? object.score : 0;
    if (i < pictures.size()) measurement.picture = pictures[i];
  }
  return measurements;
}

}  // namespace omnimapper::plugins
