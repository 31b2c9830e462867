#include <mrpt/maps/CPointsMap.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/CloudPlaneExtractor.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include <algorithm>

namespace omnimapper::perception {

using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationVelodyneScan;

const base::OptionTable<CloudSensorOptions>& CloudSensorOptions::table() {
  static const auto table = base::OptionTable<CloudSensorOptions>().list(
      "sensor_labels", &CloudSensorOptions::sensor_labels,
      "Labels of the point clouds that are used; empty uses all except those made by other extractors.");
  return table;
}

namespace {

template <class Floats>
std::vector<Eigen::Vector3f> pointsOf(const Floats& x, const Floats& y, const Floats& z) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i], z[i]);
  return points;
}

std::vector<Eigen::Vector3f> pointsOf(const CObservationVelodyneScan& scan, double min_range) {
  if (scan.point_cloud.size() > 0 || scan.scan_packets.empty())
    return pointsOf(scan.point_cloud.x, scan.point_cloud.y, scan.point_cloud.z);
  CObservationVelodyneScan unpacked = scan;
  CObservationVelodyneScan::TGeneratePointCloudParameters parameters;
  parameters.minDistance = static_cast<float>(min_range);
  try {
    unpacked.generatePointCloud(parameters);
  } catch (const std::exception& error) {
    throw base::Error(base::ExitCode::unreadable_input,
                      scan.sensorLabel + ": its packets cannot be read with its calibration: " + error.what());
  }
  return pointsOf(unpacked.point_cloud.x, unpacked.point_cloud.y, unpacked.point_cloud.z);
}

std::vector<Eigen::Vector3f> pointsOf(const mrpt::obs::CObservation& raw, double min_range) {
  if (const auto* scan = dynamic_cast<const CObservationVelodyneScan*>(&raw)) return pointsOf(*scan, min_range);
  const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&raw);
  if (cloud == nullptr)
    throw base::Error(base::ExitCode::internal, raw.sensorLabel + ": neither a point cloud nor a Velodyne scan");
  if (!cloud->pointcloud && cloud->isExternallyStored()) {
    throw base::Error(base::ExitCode::missing_images, raw.sensorLabel + ": the point cloud is in " +
                                                          cloud->getExternalStorageFile() +
                                                          ", which was not loaded; is it there?");
  }
  if (!cloud->pointcloud) return {};
  const auto& points = *cloud->pointcloud;
  return pointsOf(points.getPointsBufferRef_x(), points.getPointsBufferRef_y(), points.getPointsBufferRef_z());
}

// Whether another extractor made the cloud. Logs of derived observations contain such clouds.
bool isDerived(const mrpt::obs::CObservation& raw) {
  return LaserPointsExtractor::made(raw) || raw.sensorLabel.find(kEdgesSuffix) != std::string::npos;
}

obs::ObservedPlane observed(CloudPlane plane) {
  obs::ObservedPlane made;
  made.plane_in_sensor = plane.plane_in_sensor;
  made.covariance = plane.covariance;
  made.centroid = plane.centroid;
  made.outline = std::move(plane.outline);
  made.holes = std::move(plane.holes);
  made.inliers = static_cast<std::uint32_t>(plane.inliers);
  made.rms = plane.rms;
  return made;
}

}  // namespace

bool CloudPlaneExtractor::wants(const mrpt::obs::CObservation& raw) const {
  if (dynamic_cast<const CObservationPointCloud*>(&raw) == nullptr &&
      dynamic_cast<const CObservationVelodyneScan*>(&raw) == nullptr)
    return false;
  const auto& labels = sensors_.sensor_labels;
  if (labels.empty()) return !isDerived(raw);
  return std::find(labels.begin(), labels.end(), raw.sensorLabel) != labels.end();
}

std::shared_ptr<obs::CObservationPlanes> CloudPlaneExtractor::planesOf(const mrpt::obs::CObservation& raw) const {
  auto derived = obs::CObservationPlanes::Create();
  derived->timestamp = raw.timestamp;
  raw.getSensorPose(derived->sensorPose);
  derived->sensorLabel = raw.sensorLabel + kPlanesSuffix;
  derived->source_label = raw.sensorLabel;
  for (auto& plane : finder_.find(pointsOf(raw, options_.min_range)).planes)
    derived->planes.push_back(observed(std::move(plane)));
  return derived;
}

std::vector<mrpt::obs::CObservation::Ptr> CloudPlaneExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {planesOf(raw)};
}

std::vector<DerivedName> CloudPlaneExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kPlanesSuffix}};
}

}  // namespace omnimapper::perception
