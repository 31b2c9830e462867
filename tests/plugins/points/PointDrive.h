#pragma once

#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "points/PointPayload.h"

// Simulated drives past points whose numbers are reported, mapped by PointLandmarksPlugin.
namespace omnimapper::plugins {

inline const std::string kPointsIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = points
[odometry]
class = OdometryPlugin
[points]
class = PointLandmarksPlugin
)";

inline testing::SimulatedLogOptions pointDrive() {
  testing::SimulatedLogOptions options;
  options.lasers.clear();
  options.beacons.on = true;
  return options;
}

using Measurements = std::vector<mrpt::obs::CObservationBearingRange::TMeasurement>;

/// The observations of a log, after `change` was applied to each observation of the sensor.
inline std::vector<mrpt::obs::CObservation::Ptr> changed(const testing::SimulatedLog& log,
                                                         const std::function<void(Measurements&)>& change) {
  const auto observations = log.observations();
  for (const auto& observation : observations) {
    if (auto* seen = dynamic_cast<mrpt::obs::CObservationBearingRange*>(observation.get())) change(seen->sensedData);
  }
  return observations;
}

inline void forgetNumbers(Measurements& measurements) {
  for (auto& measurement : measurements) measurement.landmarkID = -1;
}

inline const PointPayload& payloadOf(const map::Landmark& landmark) {
  return dynamic_cast<const PointPayload&>(*landmark.payload);
}

/// The largest distance [m] of a point of the map from the nearest true one, over the floor in a planar map; the map's
/// frame is the first key frame's.
inline double worstPoint(const mapper::View& view, const testing::SimulatedLog& log,
                         const std::vector<Eigen::Vector3d>& truth) {
  const mrpt::poses::CPose3D truth_from_map(log.truthAt(view.map.key_frames.front().stamp));
  double worst = 0;
  for (const auto& [id, landmark] : view.map.landmarks) {
    if (landmark.state != map::Landmark::State::active || landmark.variables.empty()) continue;
    const Eigen::VectorXd& value = view.graph.value(landmark.variables.front());
    mrpt::math::TPoint3D there;
    truth_from_map.composePoint({value[0], value[1], value.size() > 2 ? value[2] : 0}, there);
    double nearest = 1e9;
    for (const auto& point : truth)
      nearest = std::min(
          nearest, std::hypot(there.x - point.x(), there.y - point.y(), value.size() > 2 ? there.z - point.z() : 0.0));
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace omnimapper::plugins
