#include "BeaconAssociator.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "BeaconFactor.h"
#include "BeaconPayload.h"
#include "BeaconVariable.h"

namespace beacons {

namespace base = omnimapper::base;
namespace geometry = omnimapper::geometry;
namespace graph = omnimapper::graph;
namespace landmarks = omnimapper::landmarks;
namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;
using mrpt::obs::CObservationBearingRange;

namespace {

Eigen::Vector3d sigmasOf(const BeaconOptions& options) {
  return {options.sigma_range, options.sigma_yaw, options.sigma_pitch};
}

}  // namespace

std::vector<BeaconMeasurement> measurementsOf(const CObservationBearingRange& observation) {
  std::vector<BeaconMeasurement> all;
  std::set<std::int32_t> seen;
  for (const auto& sensed : observation.sensedData) {
    BeaconMeasurement measurement{sensed.landmarkID, {sensed.range, sensed.yaw, sensed.pitch}, ""};
    if (sensed.landmarkID < 0) {
      measurement.why_useless = "it reports no number";
    } else if (!seen.insert(sensed.landmarkID).second) {
      measurement.why_useless = "its number occurs twice in the observation";
    } else if (!measurement.measured.allFinite() || !(sensed.range > 0)) {
      measurement.why_useless = "no finite range and bearing";
    }
    all.push_back(std::move(measurement));
  }
  return all;
}

void KnownBeacon::refresh(const map::Landmark& landmark, const mapper::View& view) {
  KnownLandmark::refresh(landmark, view);
  number = dynamic_cast<const BeaconPayload&>(*landmark.payload).number;
}

BeaconAssociator::BeaconAssociator(const BeaconOptions& options, const BeaconIndex& known,
                                   mapper::SensorCorrections& corrections, const CObservationBearingRange& observation,
                                   const map::KeyFrame& frame, const mapper::View& view)
    : LandmarkAssociator(options, known.owner(), frame, view),
      options_(options),
      known_(known),
      map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))),
      base_from_reported_(geometry::fromMrpt(observation.sensorLocationOnRobot)),
      correction_(corrections.find(observation.sensorLabel, frame.id, batch())),
      reported_from_sensor_(mapper::SensorCorrections::estimate(correction_, view.graph)),
      correction_covariance_(corrections.priorCovariance()) {}

void BeaconAssociator::describe(const BeaconMeasurement& measurement, mapper::Decision& decision) const {
  decision.kind = "beacon measurement";
  decision.numbers = {{"beacon", measurement.number}, {"range [m]", measurement.measured[0]}};
}

// A preselection for the gate. Here the number selects one landmark; a sensor that tells nothing apart gives all that
// are near.
std::vector<base::LandmarkId> BeaconAssociator::candidates(const BeaconMeasurement& measurement) {
  const auto* known = known_.newest([&](const KnownBeacon& each) { return each.number == measurement.number; });
  return known ? std::vector{known->id} : std::vector<base::LandmarkId>();
}

graph::FactorRecord BeaconAssociator::record(const BeaconMeasurement& measurement, base::VariableId beacon) const {
  std::vector<base::VariableId> variables{frame().pose};
  if (correction_) variables.push_back(*correction_);
  variables.push_back(beacon);
  graph::FactorRecord record{
      variables, std::make_shared<BeaconFactor>(measurement.measured, base_from_reported_, correction_.has_value()),
      graph::SquareRootInformation::fromSigmas(sigmasOf(options_))};
  record.tags.note = "beacon measurement";
  return record;
}

graph::FactorRecord BeaconAssociator::gateRecord(const BeaconMeasurement& measurement, base::VariableId beacon) const {
  if (!correction_ || !mapper::Batch::isProvisional(*correction_)) return record(measurement, beacon);
  const auto pose = graph::toValue(map_from_base_), correction = graph::toValue(reported_from_sensor_);
  const Eigen::VectorXd& position = view().graph.value(beacon);
  const double* const values[] = {pose.data(), correction.data(), position.data()};
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, 6, Eigen::RowMajor> by_correction;
  double* const jacobians[] = {nullptr, by_correction.data(), nullptr};
  BeaconFactor(measurement.measured, base_from_reported_, true).evaluate(values, residual.data(), jacobians);
  Eigen::Matrix3d noise = by_correction * correction_covariance_ * by_correction.transpose();
  noise.diagonal() += sigmasOf(options_).cwiseAbs2();
  return {{frame().pose, beacon},
          std::make_shared<BeaconFactor>(measurement.measured, base_from_reported_ * reported_from_sensor_, false),
          graph::SquareRootInformation::fromCovariance(noise)};
}

std::shared_ptr<const map::LandmarkPayload> BeaconAssociator::learned(const BeaconMeasurement& measurement,
                                                                      const landmarks::LandmarkIds& known) {
  const auto& payload = payloadOf<BeaconPayload>(known.landmark);
  const double range = measurement.measured[0];
  if (range >= payload.nearest && range <= payload.farthest) return nullptr;  // it stays as it is
  return std::make_shared<BeaconPayload>(payload.number, std::min(range, payload.nearest),
                                         std::max(range, payload.farthest));
}

void BeaconAssociator::addNew(const BeaconMeasurement& measurement, mapper::Decision decision) {
  const auto position = firstPosition(measurement);
  if (!position) {
    decision.reason = "the range does not reach to the height of the beacons";
    return batch().log(std::move(decision));
  }
  const double range = measurement.measured[0];
  addLandmark(
      measurement, std::move(decision),
      {"beacon", beaconVariable(), *position, std::make_shared<BeaconPayload>(measurement.number, range, range)});
}

// The position by range and yaw, at the known height. The distance over the floor follows from range and height.
std::optional<Eigen::Vector3d> BeaconAssociator::firstPosition(const BeaconMeasurement& measurement) const {
  const double range = measurement.measured[0], yaw = measurement.measured[1], pitch = measurement.measured[2];
  const geometry::Se3 map_from_sensor = map_from_base_ * base_from_reported_ * reported_from_sensor_;
  const Eigen::Vector3d ray(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), -std::sin(pitch));
  const Eigen::Vector2d over_floor = (map_from_sensor.rotation * ray).head<2>();
  const double up = options_.height - map_from_sensor.translation.z();
  if (range <= std::abs(up) || over_floor.norm() < 1e-6) return std::nullopt;
  const double distance = std::sqrt(range * range - up * up);
  Eigen::Vector3d position;
  position << map_from_sensor.translation.head<2>() + distance * over_floor.normalized(), options_.height;
  return position;
}

}  // namespace beacons
