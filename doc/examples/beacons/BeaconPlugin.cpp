#include "BeaconPlugin.h"

#include <mrpt/math/distributions.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "BeaconPayload.h"
#include "BeaconVariable.h"

namespace beacons {

namespace base = omnimapper::base;
namespace geometry = omnimapper::geometry;
namespace graph = omnimapper::graph;
namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;
using mrpt::obs::CObservationBearingRange;

// The pose of the sensor at an observation, as it is currently estimated.
struct BeaconPlugin::Viewpoint {
  const map::KeyFrame& frame;
  geometry::Se3 map_from_base, base_from_reported, reported_from_sensor;
  std::optional<base::VariableId> correction;  // variable of reported_from_sensor, if it is estimated

  geometry::Se3 mapFromSensor() const { return map_from_base * base_from_reported * reported_from_sensor; }
};

struct BeaconPlugin::BeaconMeasurement {
  std::int32_t number;
  Eigen::Vector3d measured;  // range, yaw, pitch
};

namespace {

// A factor linearized at an estimate, for gates: the residual and its derivative by each variable.
struct Linearized {
  using ByPose = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
  Eigen::Vector3d residual;
  ByPose by_base, by_correction;
  Eigen::Matrix<double, 3, 2, Eigen::RowMajor> by_beacon;

  Linearized(const Eigen::Vector3d& measured, const geometry::Se3& base_from_reported,
             const geometry::Se3& map_from_base, const geometry::Se3& reported_from_sensor,
             const Eigen::Vector3d& beacon) {
    const auto base = graph::toValue(map_from_base), correction = graph::toValue(reported_from_sensor);
    const double* const values[] = {base.data(), correction.data(), beacon.data()};
    double* const jacobians[] = {by_base.data(), by_correction.data(), by_beacon.data()};
    BeaconFactor(measured, base_from_reported, true).evaluate(values, residual.data(), jacobians);
  }
};

// Why a measurement cannot be used; empty if it can.
std::string whyUseless(const CObservationBearingRange::TMeasurement& measurement, const std::set<std::int32_t>& seen) {
  if (measurement.landmarkID < 0) return "it reports no number";
  if (seen.count(measurement.landmarkID) > 0) return "its number occurs twice in the observation";
  const bool finite =
      std::isfinite(measurement.range) && std::isfinite(measurement.yaw) && std::isfinite(measurement.pitch);
  return finite && measurement.range > 0 ? "" : "no finite range and bearing";
}

}  // namespace

BeaconPlugin::BeaconPlugin(const BeaconOptions& options, const mapper::PluginContext& context)
    : options_(options),
      section_(context.section),
      sigmas_(options.sigma_range, options.sigma_yaw, options.sigma_pitch),
      corrections_(options, context.section) {}

bool BeaconPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationBearingRange*>(&observation) &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

// Every measurement is logged as a decision with its reason, so that users see why a landmark was not used.
mapper::Batch BeaconPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                    const mapper::View& view) {
  const auto& observation = dynamic_cast<const CObservationBearingRange&>(observed.observation);
  mapper::Batch batch;
  std::optional<Viewpoint> from;
  std::set<std::int32_t> seen;
  for (const auto& sensed : observation.sensedData) {
    mapper::Decision decision;
    decision.stamp = frame.stamp;
    decision.plugin = section_;
    decision.kind = "beacon measurement";
    decision.from = frame.id;
    decision.numbers = {{"beacon", sensed.landmarkID}, {"range [m]", sensed.range}};
    decision.reason = whyUseless(sensed, seen);
    if (!decision.reason.empty()) {
      batch.log(decision);
      continue;
    }
    seen.insert(sensed.landmarkID);
    if (!from) from.emplace(viewpoint(frame, observation, view, batch));
    const BeaconMeasurement measurement{sensed.landmarkID, {sensed.range, sensed.yaw, sensed.pitch}};
    if (known_.count(measurement.number) > 0) {
      addToKnown(measurement, *from, view, decision, batch);
    } else {
      addNew(measurement, *from, decision, batch);
    }
  }
  return batch;
}

BeaconPlugin::Viewpoint BeaconPlugin::viewpoint(const map::KeyFrame& frame, const CObservationBearingRange& observation,
                                                const mapper::View& view, mapper::Batch& batch) {
  const auto correction = corrections_.find(observation.sensorLabel, frame.id, batch);
  return {frame, geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose)),
          geometry::fromMrpt(observation.sensorLocationOnRobot),
          mapper::SensorCorrections::estimate(correction, view.graph), correction};
}

// Adds a variable, the factor that binds it, and the landmark. Their ids are provisional: they are valid in this batch,
// and the engine replaces them by final ids, which it passes to applied().
void BeaconPlugin::addNew(const BeaconMeasurement& measurement, const Viewpoint& from, mapper::Decision decision,
                          mapper::Batch& batch) {
  const auto position = firstPosition(measurement, from);
  decision.accepted = position.has_value();
  decision.reason = position ? "new" : "the range does not reach to the height of the beacons";
  batch.log(decision);
  if (!position) return;
  const auto variable = batch.addVariable(beaconVariable(), *position);
  const double range = measurement.measured[0];
  const auto landmark =
      batch.addLandmark("beacon", {variable}, std::make_shared<BeaconPayload>(measurement.number, range, range));
  batch.addFactor(record(measurement, from, variable, landmark));
  known_[measurement.number] = {landmark, from.frame.id, covarianceSeenFrom(measurement, from, *position)};
}

void BeaconPlugin::addToKnown(const BeaconMeasurement& measurement, const Viewpoint& from, const mapper::View& view,
                              mapper::Decision decision, mapper::Batch& batch) {
  Known& known = known_.at(measurement.number);
  const map::Landmark& landmark = view.map.landmark(known.landmark);
  const auto variable = landmark.variables.front();
  auto measurement_record = record(measurement, from, variable, landmark.id);
  if (!view.areAligned(from.frame.id.session, landmark.id.session)) {
    // It would be the first factor that ties this session to the map: if it were wrong, the whole session would be
    // displaced.
    decision.reason = "waits for the consistency test";
    batch.addHypothesis(std::move(measurement_record), decision);
    return;
  }
  const Eigen::Vector3d position = view.graph.value(variable);
  decision.accepted = passesGate(measurement, from, known, position, view, decision);
  batch.log(decision);
  if (!decision.accepted) return;
  batch.addFactor(std::move(measurement_record));
  const auto& payload = dynamic_cast<const BeaconPayload&>(*landmark.payload);
  const double range = measurement.measured[0];
  const bool widens_range = range < payload.nearest || range > payload.farthest;
  batch.addEvidence(landmark.id,
                    widens_range ? std::make_shared<BeaconPayload>(measurement.number, std::min(range, payload.nearest),
                                                                   std::max(range, payload.farthest))
                                 : nullptr);
  known = {landmark.id, from.frame.id, covarianceSeenFrom(measurement, from, position)};
}

void BeaconPlugin::applied(const mapper::AppliedBatch& ids) {
  corrections_.applied(ids);
  for (auto& [number, known] : known_) {
    if (mapper::Batch::isProvisional(known.landmark)) known.landmark = ids.landmarks.at(known.landmark.index);
  }
}

// The landmarks of a continued map are in the view, and their payloads have the numbers.
void BeaconPlugin::restore(const map::MapSection* /*saved*/, const mapper::View& view) {
  for (const auto id : view.candidates(section_)) {
    const auto* payload = dynamic_cast<const BeaconPayload*>(view.map.landmark(id).payload.get());
    if (payload) known_[payload->number].landmark = id;
  }
}

// The position by range and yaw, at the known height. The distance over the floor follows from range and height.
std::optional<Eigen::Vector3d> BeaconPlugin::firstPosition(const BeaconMeasurement& measurement,
                                                           const Viewpoint& from) const {
  const double range = measurement.measured[0], yaw = measurement.measured[1], pitch = measurement.measured[2];
  const geometry::Se3 map_from_sensor = from.mapFromSensor();
  const Eigen::Vector3d ray(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), -std::sin(pitch));
  const Eigen::Vector2d over_floor = (map_from_sensor.rotation * ray).head<2>();
  const double up = options_.height - map_from_sensor.translation.z();
  if (range <= std::abs(up) || over_floor.norm() < 1e-6) return std::nullopt;
  const double distance = std::sqrt(range * range - up * up);
  Eigen::Vector3d position;
  position << map_from_sensor.translation.head<2>() + distance * over_floor.normalized(), options_.height;
  return position;
}

// Covariance of the beacon by one measurement alone, with the pose of the base taken as exact: (H^T R^-1 H)^-1, where R
// includes the uncertainty of the sensor's pose.
Eigen::Matrix2d BeaconPlugin::covarianceSeenFrom(const BeaconMeasurement& measurement, const Viewpoint& from,
                                                 const Eigen::Vector3d& beacon) const {
  const Linearized at(measurement.measured, from.base_from_reported, from.map_from_base, from.reported_from_sensor,
                      beacon);
  Eigen::Matrix3d noise = at.by_correction * corrections_.priorCovariance() * at.by_correction.transpose();
  noise.diagonal() += sigmas_.cwiseAbs2();
  return (at.by_beacon.transpose() * noise.llt().solve(at.by_beacon)).inverse();
}

// Tests the chi-square of the residual, with the covariances of the measurement, of the beacon by its last measurement,
// and of the motion of the base since then. The graph may know the beacon better; then the gate is wider than
// necessary.
bool BeaconPlugin::passesGate(const BeaconMeasurement& measurement, const Viewpoint& from, const Known& known,
                              const Eigen::Vector3d& beacon, const mapper::View& view,
                              mapper::Decision& decision) const {
  decision.reason = "known";
  if (options_.confidence >= 1 || !known.seen_from) return true;
  const auto motion = view.covarianceBetween(*known.seen_from, from.frame.id);
  if (!motion) return true;  // the uncertainty of the motion is unknown
  const Linearized at(measurement.measured, from.base_from_reported, from.map_from_base, from.reported_from_sensor,
                      beacon);
  Eigen::Matrix3d covariance = at.by_base * *motion * at.by_base.transpose() +
                               at.by_beacon * known.covariance * at.by_beacon.transpose() +
                               at.by_correction * corrections_.priorCovariance() * at.by_correction.transpose();
  covariance.diagonal() += sigmas_.cwiseAbs2();
  const double chi2 = at.residual.dot(covariance.llt().solve(at.residual));
  const double limit = mrpt::math::chi2inv(options_.confidence, 3);
  decision.numbers.emplace_back("chi-square", chi2);
  decision.numbers.emplace_back("limit", limit);
  if (chi2 <= limit) return true;
  decision.reason = "gated out: too far from where the beacon should be";
  return false;
}

graph::FactorRecord BeaconPlugin::record(const BeaconMeasurement& measurement, const Viewpoint& from,
                                         base::VariableId beacon, base::LandmarkId landmark) const {
  std::vector<base::VariableId> variables{from.frame.pose};
  if (from.correction) variables.push_back(*from.correction);
  variables.push_back(beacon);
  graph::FactorRecord record{
      variables,
      std::make_shared<BeaconFactor>(measurement.measured, from.base_from_reported, from.correction.has_value()),
      graph::SquareRootInformation::fromSigmas(sigmas_)};
  record.tags.owner = section_;
  record.tags.landmark = landmark;
  record.tags.note = "beacon measurement";
  return record;
}

}  // namespace beacons
