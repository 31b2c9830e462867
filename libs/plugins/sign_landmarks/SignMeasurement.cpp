#include "SignMeasurement.h"

#include <mrpt/img/CImage.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace omnimapper::plugins {

using Eigen::Vector3d;

namespace {

graph::FactorRecord recordOf(const std::vector<base::VariableId>& variables,
                             std::shared_ptr<const graph::Factor> factor, const Eigen::VectorXd& sigmas,
                             const char* note) {
  graph::FactorRecord record{variables, std::move(factor), graph::SquareRootInformation::fromSigmas(sigmas)};
  record.tags.note = note;
  return record;
}

double areaOf(const obs::ObservedDoorSign& sign) {
  double doubled = 0;
  for (std::size_t i = 0; i < sign.corners_px.size(); ++i) {
    const Eigen::Vector2d a = sign.corners_px[i].cast<double>();
    const Eigen::Vector2d b = sign.corners_px[(i + 1) % sign.corners_px.size()].cast<double>();
    doubled += a.x() * b.y() - a.y() * b.x();
  }
  return std::isfinite(doubled) ? std::abs(doubled) / 2 : 0;
}

// Reduces the image, so that maps and waiting measurements stay small.
mrpt::img::CImage reduced(const mrpt::img::CImage& patch) {
  constexpr double kMostPixels = 120 * 80;
  if (patch.isEmpty()) return patch;
  const auto width = static_cast<double>(patch.getWidth()), height = static_cast<double>(patch.getHeight());
  const double scale = std::sqrt(kMostPixels / (width * height));
  if (scale >= 1) return patch;
  mrpt::img::CImage small;
  patch.scaleImage(small, std::max(1U, static_cast<unsigned>(width * scale)),
                   std::max(1U, static_cast<unsigned>(height * scale)), mrpt::img::IMG_INTERP_AREA);
  return small;
}

map::Photograph photographOf(const mrpt::img::CImage& patch) {
  map::Photograph photograph;
  photograph.width = static_cast<int>(patch.getWidth());
  photograph.height = static_cast<int>(patch.getHeight());
  const std::size_t channels = patch.isColor() ? 3 : 1;
  for (int y = 0; y < photograph.height; ++y) {
    const auto* pixel = patch.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (int x = 0; x < photograph.width; ++x, pixel += channels)  // blue first
      photograph.rgb.insert(photograph.rgb.end(), {pixel[channels - 1], pixel[channels / 2], pixel[0]});
  }
  return photograph;
}

}  // namespace

SignLook SignMeasurement::look(base::KeyFrameId frame) const {
  const bool has_patch = !patch.isEmpty();
  return {frame, seen.direction(), area_px,
          has_patch ? std::make_shared<const map::Photograph>(photographOf(patch)) : nullptr};
}

graph::FactorRecord SignMeasurement::directionRecord(base::VariableId pose, base::VariableId point,
                                                     std::optional<base::VariableId> offsets,
                                                     const SignLandmarksOptions& options) const {
  std::vector<base::VariableId> variables{pose, point};
  std::shared_ptr<const graph::Factor> factor;
  if (offsets) {
    variables.push_back(*offsets);
    factor = std::make_shared<PanTiltBearingFactor>(seen, tilt_axis);
  } else {
    factor = std::make_shared<SignBearingFactor>(seen);
  }
  auto record = recordOf(variables, std::move(factor), Eigen::Vector2d(sigma_left, sigma_down), "sign measurement");
  record.loss = graph::Loss::cauchy(options.loss_scale);
  return record;
}

std::optional<graph::FactorRecord> SignMeasurement::rangeRecord(base::VariableId pose, base::VariableId point) const {
  constexpr double kLossScale = 2;  // [sigma] a beam may end before the sign or behind it
  if (!range) return std::nullopt;
  auto record = recordOf({pose, point}, std::make_shared<SignRangeFactor>(seen.camera(), *range),
                         Eigen::VectorXd::Constant(1, range_sigma / *range), "range of a sign");
  record.loss = graph::Loss::cauchy(kLossScale);
  return record;
}

graph::FactorRecord SignMeasurement::legibilityRecord(base::VariableId pose, base::VariableId point) const {
  constexpr double kFactor = 2.2;  // two signs of three are read from 1.1 to 5.5 m
  return recordOf({pose, point}, std::make_shared<SignRangeFactor>(seen.camera(), kReadingDistance),
                  Eigen::VectorXd::Constant(1, std::log(kFactor)), "a sign is read from near");
}

std::vector<SignMeasurement> signMeasurements(const obs::CObservationDoorSigns& observation,
                                              const SignLandmarksOptions& options) {
  constexpr double kLeastLevel = 0.05;  // smallest horizontal component of a direction
  // [rad] Standard deviation of the middle of a plate that the edge of the image cuts: measured on signs_30 and
  // signs_200 (doc/results/signs.md).
  constexpr double kSigmaOfCut = 0.025;
  constexpr double kLeastRelative = 1e-4,
                   kMostRelative = 10;  // standard deviation / range; ranges outside are not used
  const geometry::Se3 base_from_camera = geometry::fromMrpt(observation.sensorPose);
  const Vector3d left = base_from_camera.rotation * -Vector3d::UnitX();
  const double length = left.head<2>().norm();
  const Vector3d tilt_axis = length > 0.5 ? Vector3d(left.x() / length, left.y() / length, 0) : Vector3d::UnitY();
  std::vector<SignMeasurement> measurements;
  for (const auto& sign : observation.signs) {
    SignText text = textOf(sign, options.min_confidence);
    const Vector3d direction = base_from_camera.rotation * sign.ray;
    const double level = direction.head<2>().norm();
    if (text.empty() || !direction.allFinite() || !(level > kLeastLevel)) continue;
    const double relative = sign.range ? sign.range_sigma / *sign.range : 0;
    const bool has_range = sign.range && *sign.range > 0 && std::isfinite(*sign.range) && relative > kLeastRelative &&
                           relative < kMostRelative;
    const double pixel_sigma = sign.is_cut ? std::hypot(options.pixel_sigma, kSigmaOfCut) : options.pixel_sigma;
    // A pan rotates a direction near the vertical by a smaller angle.
    measurements.push_back({std::move(text), MeasuredDirection(base_from_camera.translation, direction.normalized()),
                            tilt_axis, std::hypot(pixel_sigma, level * options.pan_sigma),
                            std::hypot(pixel_sigma, options.tilt_sigma), has_range ? sign.range : std::nullopt,
                            sign.range_sigma, areaOf(sign), reduced(sign.patch)});
  }
  return measurements;
}

}  // namespace omnimapper::plugins
