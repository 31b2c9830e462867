#pragma once

#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/landmarks/LandmarkAssociator.h>
#include <omnimapper/landmarks/LandmarkIndex.h>
#include <omnimapper/plugin/SensorCorrections.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "BeaconOptions.h"

namespace beacons {

// Step 5: what the measurements of one observation mean. The base class does the rest: the gate, new and known
// landmarks, evidence, decisions, and hypotheses between sessions.

/// One measurement of an observation.
struct BeaconMeasurement {
  std::int32_t number;       ///< of the beacon
  Eigen::Vector3d measured;  ///< range [m], yaw, pitch [rad]
  std::string why_useless;   ///< empty if it can be used
};
/// All measurements of an observation, in its order.
std::vector<BeaconMeasurement> measurementsOf(const mrpt::obs::CObservationBearingRange& observation);

/// What the plugin keeps of a beacon, beside map and graph.
struct KnownBeacon : omnimapper::landmarks::KnownLandmark {
  std::int32_t number = -1;

  void refresh(const omnimapper::map::Landmark& landmark, const omnimapper::mapper::View& view);
};
using BeaconIndex = omnimapper::landmarks::LandmarkIndex<KnownBeacon>;

class BeaconAssociator : public omnimapper::landmarks::LandmarkAssociator<BeaconMeasurement> {
 public:
  /// All references must outlive this object.
  BeaconAssociator(const BeaconOptions& options, const BeaconIndex& known,
                   omnimapper::mapper::SensorCorrections& corrections,
                   const mrpt::obs::CObservationBearingRange& observation, const omnimapper::map::KeyFrame& frame,
                   const omnimapper::mapper::View& view);

 protected:
  void describe(const BeaconMeasurement& measurement, omnimapper::mapper::Decision& decision) const override;
  std::string whyUseless(const BeaconMeasurement& measurement) const override { return measurement.why_useless; }
  bool isIdentified(const BeaconMeasurement& /*measurement*/) const override { return true; }
  std::vector<omnimapper::base::LandmarkId> candidates(const BeaconMeasurement& measurement) override;
  omnimapper::graph::FactorRecord record(const BeaconMeasurement& measurement,
                                         omnimapper::base::VariableId beacon) const override;
  // The correction of the sensor's pose is a variable. If this batch adds it, its covariance is part of the noise.
  omnimapper::graph::FactorRecord gateRecord(const BeaconMeasurement& measurement,
                                             omnimapper::base::VariableId beacon) const override;
  std::shared_ptr<const omnimapper::map::LandmarkPayload> learned(
      const BeaconMeasurement& measurement, const omnimapper::landmarks::LandmarkIds& known) override;
  void addNew(const BeaconMeasurement& measurement, omnimapper::mapper::Decision decision) override;

 private:
  std::optional<Eigen::Vector3d> firstPosition(const BeaconMeasurement& measurement) const;

  const BeaconOptions& options_;
  const BeaconIndex& known_;
  const omnimapper::geometry::Se3 map_from_base_, base_from_reported_;
  const std::optional<omnimapper::base::VariableId> correction_;  // variable of reported_from_sensor, if estimated
  const omnimapper::geometry::Se3 reported_from_sensor_;
  const omnimapper::geometry::Matrix6d correction_covariance_;  // before it is estimated
};

}  // namespace beacons
