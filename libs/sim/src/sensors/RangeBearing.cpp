#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/RangeBearing.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "OptionChecks.h"
#include "TruthText.h"

namespace omnimapper::sim {

namespace {

constexpr double kOnSurface = 0.02;   // [m] largest depth of a landmark in the body it is fixed to
constexpr double kMarkerAngle = 1.3;  // [rad] largest angle from its normal at which a marker is measured
constexpr std::uint64_t kFalseStream = 1;

// Knuth's method: the number of uniform numbers whose product stays above e^-mean.
int poisson(double mean, Random& random) {
  int count = 0;
  for (double product = random.uniform(); product > std::exp(-mean); product *= random.uniform()) ++count;
  return count;
}

}  // namespace

const base::OptionTable<RangeBearingOptions>& RangeBearingOptions::table() {
  using base::Range;
  using Options = RangeBearingOptions;
  const Range zero_or_more = Range::notNegative();
  static const auto table =
      base::OptionTable<Options>()
          .flag("points", &Options::points, "The sensor measures the point landmarks of the world.")
          .flag("markers", &Options::markers,
                "The sensor measures the centres of the square markers of the world, if it is in front of them.")
          .flag("known_ids", &Options::known_ids,
                "Each measurement reports the id of its landmark. Otherwise the reported id is -1.")
          .flag("planar", &Options::planar, "Measurements have pitch 0, and their range is the horizontal one.")
          .number("min_range_m", &Options::min_range, zero_or_more, "Shortest range at which a landmark is measured.")
          .number("max_range_m", &Options::max_range, Range::positive(),
                  "Longest range at which a landmark is measured.")
          .number("fov_yaw_deg", &Options::fov_yaw, {1, 360}, "Full horizontal field of view.")
          .number("fov_pitch_deg", &Options::fov_pitch, {1, 180}, "Full vertical field of view.")
          .number("sigma_range_m", &Options::sigma_range, zero_or_more, "Standard deviation of the reported range.")
          .number("sigma_deg", &Options::sigma_angle, zero_or_more, "Standard deviation of the reported yaw and pitch.")
          .number("missed", &Options::missed, {0, 1}, "Fraction of the visible landmarks that are not reported.")
          .number("false_alarms", &Options::false_alarms, {0, 100},
                  "Mean number of false measurements in an observation.")
          .flag("occlusion", &Options::occlusion, "Landmarks behind other objects are hidden.");
  return table;
}

RangeBearing::RangeBearing(const RangeBearingOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context), options_(options) {
  const World& world = *context.world;
  const auto trackOf = [&](const std::string& name) -> const Track* {
    for (const Body& body : world.bodies) {
      if (body.name == name) return &body.track;
    }
    return nullptr;
  };
  for (const PointLandmark& point : world.point_landmarks) {
    if (options.points) landmarks_.push_back({point.name, point.id, trackOf(point.body), point.in_body, false});
  }
  for (const Marker& marker : world.markers) {
    if (options.markers) landmarks_.push_back({marker.name, marker.id, trackOf(marker.name), {0, 0, 0}, true});
  }
  if (options.known_ids) refuseDoubleIds();
  requireBelow(context.place(), "min_range_m", options.min_range, "max_range_m", options.max_range);
}

// MRPT does not accept an observation that contains an id twice.
void RangeBearing::refuseDoubleIds() const {
  std::map<int, std::string> names;
  for (const auto& landmark : landmarks_) {
    const auto [first, is_new] = names.emplace(landmark.id, landmark.name);
    if (is_new) continue;
    throw base::Error(base::ExitCode::out_of_range,
                      context().place() + "points, markers: " + first->second + " and " + landmark.name +
                          " have the same id " + std::to_string(landmark.id) +
                          "; leave one kind out, give other ids, or set known_ids = false");
  }
}

std::vector<RangeBearing::Landmark> RangeBearing::visible(int k, std::vector<Eigen::Vector3d>& in_sensor) const {
  const double time = timeOf(k);
  const geometry::Se3 map_from_sensor = mapFromSensor(time), sensor_from_map = geometry::inverse(map_from_sensor);
  std::vector<Landmark> found;
  std::vector<Ray> rays;
  for (const Landmark& landmark : landmarks_) {
    const auto map_from_body = landmark.map_from_body ? landmark.map_from_body->at(time) : geometry::Se3{};
    if (!map_from_body) continue;
    const Eigen::Vector3d in_map = *map_from_body * landmark.in_body, point = sensor_from_map * in_map;
    const double range = point.norm(), yaw = std::atan2(point.y(), point.x()), pitch = std::asin(-point.z() / range);
    if (!(range >= options_.min_range && range <= options_.max_range) || std::abs(yaw) > 0.5 * options_.fov_yaw ||
        std::abs(pitch) > 0.5 * options_.fov_pitch)
      continue;
    const Eigen::Vector3d direction = (in_map - map_from_sensor.translation) / range;
    if (landmark.is_marker &&
        -(map_from_body->rotation * Eigen::Vector3d::UnitZ()).dot(direction) < std::cos(kMarkerAngle))
      continue;
    found.push_back(landmark);
    in_sensor.push_back(point);
    rays.push_back({map_from_sensor.translation, direction, 0, std::max(0.0, range - kOnSurface)});
  }
  if (!options_.occlusion || rays.empty()) return found;
  std::vector<char> blocked;
  context().scenes->at(time).findBlocked(rays, blocked);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (blocked[i]) continue;
    found[kept] = found[i], in_sensor[kept] = in_sensor[i];
    ++kept;
  }
  found.erase(found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
  in_sensor.resize(kept);
  return found;
}

Measurement RangeBearing::measure(int k) const {
  struct One {
    double range, yaw, pitch;
    int id;
    std::string name;
  };
  std::vector<Eigen::Vector3d> in_sensor;
  const std::vector<Landmark> landmarks = visible(k, in_sensor);
  std::vector<One> all;
  Random random = randomOf(k);
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::Vector3d& p = in_sensor[i];
    const double noise_range = random.gaussian(options_.sigma_range), noise_yaw = random.gaussian(options_.sigma_angle);
    const double noise_pitch = random.gaussian(options_.sigma_angle);
    if (random.chance(options_.missed)) continue;
    const double range = options_.planar ? p.head<2>().norm() : p.norm();
    const double pitch = options_.planar ? 0 : std::asin(-p.z() / p.norm()) + noise_pitch;
    all.push_back(
        {range + noise_range, std::atan2(p.y(), p.x()) + noise_yaw, pitch, landmarks[i].id, landmarks[i].name});
  }
  Random ghosts = randomOf(k, kFalseStream);
  for (int i = poisson(options_.false_alarms, ghosts); i > 0; --i) {
    const double range = ghosts.uniform(options_.min_range, options_.max_range);
    const double yaw = options_.fov_yaw * (ghosts.uniform() - 0.5);
    const double pitch = options_.planar ? 0 : options_.fov_pitch * (ghosts.uniform() - 0.5);
    all.push_back({range, yaw, pitch, -1, ""});
  }
  if (all.empty()) return {};
  // The order must not reveal which landmark a measurement is of.
  for (int i = static_cast<int>(all.size()) - 1; i > 0; --i) std::swap(all[i], all[ghosts.integer(0, i)]);

  auto observation = mrpt::obs::CObservationBearingRange::Create();
  stamp(*observation, k);
  observation->sensorLocationOnRobot = geometry::toMrpt(baseFromSensor());
  observation->minSensorDistance = static_cast<float>(options_.min_range);
  observation->maxSensorDistance = static_cast<float>(options_.max_range);
  observation->fieldOfView_yaw = static_cast<float>(options_.fov_yaw);
  observation->fieldOfView_pitch = static_cast<float>(options_.fov_pitch);
  observation->sensor_std_range = static_cast<float>(options_.sigma_range);
  observation->sensor_std_yaw = static_cast<float>(options_.sigma_angle);
  observation->sensor_std_pitch = static_cast<float>(options_.planar ? 0 : options_.sigma_angle);
  auto names = nlohmann::ordered_json::array(), ids = nlohmann::ordered_json::array();
  for (const One& one : all) {
    mrpt::obs::CObservationBearingRange::TMeasurement measurement;
    measurement.range = static_cast<float>(one.range);
    measurement.yaw = static_cast<float>(one.yaw);
    measurement.pitch = static_cast<float>(one.pitch);
    measurement.landmarkID = options_.known_ids ? one.id : -1;
    measurement.covariance.setZero();
    observation->sensedData.push_back(measurement);
    names.push_back(one.name);
    ids.push_back(one.id);
  }
  const nlohmann::ordered_json line{{"landmarks", names}, {"ids", ids}};
  return {observation, line.dump(), {}};
}

}  // namespace omnimapper::sim
