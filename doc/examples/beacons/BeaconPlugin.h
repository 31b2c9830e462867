#pragma once

#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/plugin/MeasurementPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/SensorCorrections.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "BeaconFactor.h"
#include "BeaconOptions.h"

namespace beacons {

// Step 5: the plugin. It gets observations and returns batches of edits; applied() gets the ids of what a batch added.
// The plugin never changes the map or the graph itself, and one thread calls it.

/// Beacons with numbers, from ranges and bearings (CObservationBearingRange). A beacon is added with its first
/// measurement; later measurements are associated by number and gated. In a session that is not aligned with the map
/// yet, a measurement of a beacon of an earlier session is a hypothesis.
class BeaconPlugin : public omnimapper::mapper::MeasurementPlugin {
 public:
  BeaconPlugin(const BeaconOptions& options, const omnimapper::mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  omnimapper::mapper::Batch measure(const omnimapper::map::KeyFrame& frame,
                                    const omnimapper::mapper::Observed& observed,
                                    const omnimapper::mapper::View& view) override;
  void applied(const omnimapper::mapper::AppliedBatch& ids) override;
  void restore(const omnimapper::map::MapSection* saved, const omnimapper::mapper::View& view) override;
  // Not needed here: spliced(), because a measurement binds only one key frame; prepare(), because there is no heavy
  // work; save(), because the payloads of the landmarks have all that restore() needs.

 private:
  /// What the plugin keeps of a beacon, beside map and graph.
  struct Known {
    omnimapper::base::LandmarkId landmark;                  // provisional between measure() and applied()
    std::optional<omnimapper::base::KeyFrameId> seen_from;  // the last one; none if it was in an earlier session
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the beacon by its measurement from there, with the pose
                                                           // of the base taken as exact
  };
  struct Viewpoint;
  struct BeaconMeasurement;

  Viewpoint viewpoint(const omnimapper::map::KeyFrame& frame, const mrpt::obs::CObservationBearingRange& observation,
                      const omnimapper::mapper::View& view, omnimapper::mapper::Batch& batch);
  std::optional<Eigen::Vector3d> firstPosition(const BeaconMeasurement& measurement, const Viewpoint& from) const;
  Eigen::Matrix2d covarianceSeenFrom(const BeaconMeasurement& measurement, const Viewpoint& from,
                                     const Eigen::Vector3d& beacon) const;
  bool passesGate(const BeaconMeasurement& measurement, const Viewpoint& from, const Known& known,
                  const Eigen::Vector3d& beacon, const omnimapper::mapper::View& view,
                  omnimapper::mapper::Decision& decision) const;
  omnimapper::graph::FactorRecord record(const BeaconMeasurement& measurement, const Viewpoint& from,
                                         omnimapper::base::VariableId beacon,
                                         omnimapper::base::LandmarkId landmark) const;
  void addNew(const BeaconMeasurement& measurement, const Viewpoint& from, omnimapper::mapper::Decision decision,
              omnimapper::mapper::Batch& batch);
  void addToKnown(const BeaconMeasurement& measurement, const Viewpoint& from, const omnimapper::mapper::View& view,
                  omnimapper::mapper::Decision decision, omnimapper::mapper::Batch& batch);

  BeaconOptions options_;
  std::string section_;
  Eigen::Vector3d sigmas_;  // range, yaw, pitch
  omnimapper::mapper::SensorCorrections corrections_;
  std::map<std::int32_t, Known> known_;  // by number
};

// Step 6: the factory, an MRPT run-time class without state, so that an INI can name the plugin: "class =
// BeaconPlugin".
class BeaconPluginFactory : public omnimapper::mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(BeaconPluginFactory, beacons)
 public:
  std::string name() const override { return "BeaconPlugin"; }
  std::string summary() const override { return "Beacons with numbers, from ranges and bearings."; }
  const std::vector<omnimapper::base::OptionSpec>& options() const override { return BeaconOptions::table().specs(); }
  void registerKinds(omnimapper::mapper::Kinds& kinds) const override;
  std::unique_ptr<omnimapper::mapper::MeasurementPlugin> make(
      const omnimapper::base::ConfigSection& section, const omnimapper::mapper::PluginContext& context) const override;
};

}  // namespace beacons
