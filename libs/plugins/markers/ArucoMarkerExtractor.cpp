#include "ArucoMarkerExtractor.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "MarkerFinder.h"
#include "MarkerPose.h"

namespace omnimapper::perception {

const base::OptionTable<ArucoMarkerOptions>& ArucoMarkerOptions::table() {
  using Options = ArucoMarkerOptions;
  using D = Dictionary;
  using base::Range;
  static const auto table =
      base::OptionTable<Options>()
          .choice<D>("dictionary", &Options::dictionary,
                     {{"4x4_50", D::dict_4x4_50},     {"4x4_100", D::dict_4x4_100},    {"4x4_250", D::dict_4x4_250},
                      {"4x4_1000", D::dict_4x4_1000}, {"5x5_50", D::dict_5x5_50},      {"5x5_100", D::dict_5x5_100},
                      {"5x5_250", D::dict_5x5_250},   {"5x5_1000", D::dict_5x5_1000},  {"6x6_50", D::dict_6x6_50},
                      {"6x6_100", D::dict_6x6_100},   {"6x6_250", D::dict_6x6_250},    {"6x6_1000", D::dict_6x6_1000},
                      {"7x7_50", D::dict_7x7_50},     {"7x7_100", D::dict_7x7_100},    {"7x7_250", D::dict_7x7_250},
                      {"7x7_1000", D::dict_7x7_1000}, {"original", D::original},       {"april_16h5", D::april_16h5},
                      {"april_25h9", D::april_25h9},  {"april_36h10", D::april_36h10}, {"april_36h11", D::april_36h11}},
                     "Dictionary of the markers. 4x4_50, for example, has 50 markers with 4 cells along a side. "
                     "original is ArUco's original dictionary; the names with april_ are AprilTag families.")
          .number("side_m", &Options::side, {1e-3, 100}, "Side length of a marker's black square.")
          .number("corner_sigma_px", &Options::corner_sigma, {1e-3, 100},
                  "Standard deviation of a marker's corner in the image, from which covariances are computed.")
          .number("min_side_px", &Options::min_side, {8, 10000},
                  "Markers whose sides are shorter than this in the image are left out.")
          .choice<Refinement>(
              "refinement", &Options::refinement,
              {{"none", Refinement::none}, {"gradients", Refinement::gradients}, {"edges", Refinement::edges}},
              "How marker corners are located more finely than to a pixel. none: they are not. gradients: by the image "
              "gradients around a corner. edges: by the lines along the marker's sides.");
  return table;
}

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mrpt::obs::CObservationBearingRange;

// Range, yaw and pitch of a point in MRPT's axes. The point must not be straight above or below the sensor.
CObservationBearingRange::TMeasurement measurementOf(int id, const Vector3d& point, const Matrix3d& covariance) {
  const double range = point.norm(), flat_squared = point.head<2>().squaredNorm(), flat = std::sqrt(flat_squared);
  Matrix3d by_point;
  by_point.row(0) = point.transpose() / range;
  by_point.row(1) << -point.y() / flat_squared, point.x() / flat_squared, 0;
  by_point.row(2) = Vector3d(point.z() * point.x(), point.z() * point.y(), -flat_squared) / (range * range * flat);
  CObservationBearingRange::TMeasurement measurement;
  measurement.range = static_cast<float>(range);
  measurement.yaw = static_cast<float>(std::atan2(point.y(), point.x()));
  measurement.pitch = static_cast<float>(std::atan2(-point.z(), flat));
  measurement.landmarkID = id;
  measurement.covariance = Matrix3d(by_point * covariance * by_point.transpose());
  return measurement;
}

float fieldOfView(int pixels, double focal) {
  return static_cast<float>(2 * std::atan(0.5 * pixels / focal));
}

}  // namespace

CObservationBearingRange::Ptr ArucoMarkerExtractor::markersIn(const mrpt::obs::CObservation& raw) const {
  const auto picture = camera::pictureOf(raw);
  auto observation = CObservationBearingRange::Create();
  observation->timestamp = raw.timestamp;
  observation->sensorLabel = raw.sensorLabel + kMarkersSuffix;
  const geometry::Se3 optical_from_sensor = geometry::inverse(geometry::sensorFromOptical());
  observation->sensorLocationOnRobot = geometry::toMrpt(geometry::fromMrpt(picture.pose) * optical_from_sensor);
  observation->validCovariances = true;
  if (picture.image == nullptr) return observation;
  const camera::LensModel lens(*picture.camera, raw.sensorLabel);
  observation->fieldOfView_yaw = fieldOfView(static_cast<int>(picture.image->getWidth()), picture.camera->fx());
  observation->fieldOfView_pitch = fieldOfView(static_cast<int>(picture.image->getHeight()), picture.camera->fy());
  const Matrix3d axes = geometry::sensorFromOptical().rotation.toRotationMatrix();
  try {
    for (const auto& marker : markers::findMarkers(*picture.image, options_)) {
      const auto pose = markers::poseOfMarker(lens, marker.corners, options_.side, options_.corner_sigma);
      if (!pose) continue;
      observation->sensedData.push_back(measurementOf(marker.id,
                                                      camera::toSensor(pose->optical_from_marker.translation),
                                                      axes * pose->covariance_of_middle * axes.transpose()));
    }
  } catch (const cv::Exception& error) {
    throw base::Error(base::ExitCode::unreadable_input,
                      raw.sensorLabel + ": OpenCV cannot look for markers in this picture: " + error.err);
  }
  return observation;
}

bool ArucoMarkerExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::bringsPicture(raw);
}

std::vector<mrpt::obs::CObservation::Ptr> ArucoMarkerExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {markersIn(raw)};
}

std::vector<DerivedName> ArucoMarkerExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(CObservationBearingRange), raw.sensorLabel + kMarkersSuffix}};
}

}  // namespace omnimapper::perception
