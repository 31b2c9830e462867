#pragma once

#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/CloudPlaneFinder.h>
#include <omnimapper/perception/Extractor.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::perception {

struct CloudSensorOptions {
  std::vector<std::string> sensor_labels;  ///< of the clouds to use; empty: all that no other extractor made

  static const base::OptionTable<CloudSensorOptions>& table();
};

/// Extracts the planes of point clouds without order (thesis 3.3), such as those of 3D lasers, of tilting lasers and of
/// merged views, as CloudPlaneFinder finds them.
class CloudPlaneExtractor : public Extractor {
 public:
  static constexpr const char* kName = "CloudPlaneExtractor";
  static constexpr const char* kSummary =
      "Planes of point clouds without order, such as those of 3D lasers, with outlines and covariance.";

  /// Throws as CloudPlaneFinder.
  CloudPlaneExtractor(const CloudPlaneOptions& planes, const CloudSensorOptions& sensors)
      : options_(planes), finder_(planes), sensors_(sensors) {}

  /// The planes of a cloud, in the frame of its sensorPose. They have the stamp and the sensorPose of the cloud, and
  /// the label "<label of the cloud>.planes". If a Velodyne scan has packets but no points, the points are computed
  /// from the packets, as if the sensor stood still. Throws Error(unreadable_input) for packets that do not fit their
  /// calibration, Error(missing_images) for clouds in files that were not loaded (sources load such files), and
  /// Error(internal) for other observations. Thread-safe; the same cloud gives the same bits.
  std::shared_ptr<obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation& raw) const;

  /// True for clouds and Velodyne scans of the sensors to use.
  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  CloudPlaneOptions options_;
  CloudPlaneFinder finder_;
  CloudSensorOptions sensors_;
};

}  // namespace omnimapper::perception
