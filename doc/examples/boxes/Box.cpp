#include "Box.h"

#include <omnimapper/geometry/Conversions.h>

namespace boxes {

using omnimapper::base::Range;

const omnimapper::base::OptionTable<BoxOptions>& BoxOptions::table() {
  static const auto table = [] {
    auto own = omnimapper::base::OptionTable<BoxOptions>()
                   .number("min_score", &BoxOptions::min_score, Range{0, 1},
                           "The class of an object whose score is lower counts as unknown.")
                   .number("sigma_m", &BoxOptions::sigma, Range::positive(),
                           "Standard deviation of the middle of a box along each axis, in addition to what the "
                           "detector reports.");
    return declareIn(own);  // the keys of AssociationOptions
  }();
  return table;
}

std::vector<Box> boxesOf(const omnimapper::obs::CObservationObjects& observation, const BoxOptions& options) {
  const auto base_from_sensor = omnimapper::geometry::fromMrpt(observation.sensorPose);
  const Eigen::Matrix3d rotation = base_from_sensor.rotation.toRotationMatrix();
  std::vector<Box> boxes;
  for (const auto& object : observation.objects) {
    const bool is_known = object.score >= options.min_score;
    boxes.push_back({base_from_sensor * object.sensor_from_box, object.box_size,
                     rotation * object.covariance * rotation.transpose() +
                         options.sigma * options.sigma * Eigen::Matrix3d::Identity(),
                     is_known ? object.class_label : "", is_known ? object.score : 0});
  }
  return boxes;
}

bool mayBeOne(const std::string& class_label, const std::string& other) {
  return class_label == other || class_label.empty() || other.empty();
}

}  // namespace boxes
