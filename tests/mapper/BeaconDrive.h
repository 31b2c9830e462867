#pragma once

#include <BeaconPayload.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <string>

// A simulated drive past beacons, mapped by the plugin of doc/add_a_landmark_type.md.
namespace beacons {

inline const std::string kBeaconIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = beacons
[odometry]
class = OdometryPlugin
[beacons]
class           = BeaconPlugin
label           = beacons
height_m        = 1.4
sigma_range_m   = 0.02
sigma_yaw_deg   = 0.3
sigma_pitch_deg = 0.3
)";

inline omnimapper::testing::SimulatedLogOptions drive() {
  omnimapper::testing::SimulatedLogOptions options;
  options.lasers.clear();
  options.beacons.on = true;
  return options;
}

inline const BeaconPayload& payloadOf(const omnimapper::map::Landmark& landmark) {
  return dynamic_cast<const BeaconPayload&>(*landmark.payload);
}

// The largest distance [m] of a landmark from where its beacon is; the map's frame is the first key frame's.
inline double worstBeacon(const omnimapper::mapper::View& view, const omnimapper::testing::SimulatedLog& log,
                          const omnimapper::testing::SimulatedLogOptions& options) {
  const mrpt::poses::CPose3D truth_from_map(log.truthAt(view.map.key_frames.front().stamp));
  double worst = 0;
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto& value = view.graph.value(landmark.variables.front());
    mrpt::math::TPoint3D there;
    truth_from_map.composePoint({value[0], value[1], value[2]}, there);
    const auto& truth = options.beacons.positions.at(static_cast<std::size_t>(payloadOf(landmark).number));
    worst = std::max(worst, (Eigen::Vector3d(there.x, there.y, there.z) - truth).norm());
  }
  return worst;
}

}  // namespace beacons
