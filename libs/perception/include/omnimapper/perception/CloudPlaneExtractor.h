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
  std::vector<std::string> sensor_labels;  ///< of clouds that count; none: all but those of other extractors

  static const base::OptionTable<CloudSensorOptions>& table();
};

/// The planes of point clouds without order (thesis 3.3), as CloudPlaneFinder finds them: of 3D lasers, of lasers that
/// tilt, of views that were merged.
class CloudPlaneExtractor : public Extractor {
 public:
  static constexpr const char* kName = "CloudPlaneExtractor";
  static constexpr const char* kSummary =
      "Planes of point clouds without order, such as those of 3D lasers, with outlines and covariance.";

  /// Throws as CloudPlaneFinder.
  CloudPlaneExtractor(const CloudPlaneOptions& planes, const CloudSensorOptions& sensors)
      : options_(planes), finder_(planes), sensors_(sensors) {}

  /// Planes with the observation's stamp and sensorPose, in the frame of that pose, label "<its label>.planes". Of a
  /// Velodyne scan without points these are made of its packets, as if the sensor stood still. Throws
  /// Error(unreadable_input) for packets that do not fit their calibration, Error(missing_images) for clouds that are
  /// in files and were not loaded (sources load them), and Error(internal) for other observations. Thread-safe; the
  /// same cloud gives the same bits.
  std::shared_ptr<obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation& raw) const;

  /// Clouds and Velodyne scans of the sensors that count.
  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  CloudPlaneOptions options_;
  CloudPlaneFinder finder_;
  CloudSensorOptions sensors_;
};

}  // namespace omnimapper::perception
