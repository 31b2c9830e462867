#pragma once

#include <omnimapper/sim/Sensor.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

struct RangeBearingOptions {
  bool points = true;                       ///< measures World::point_landmarks
  bool markers = true;                      ///< measures the centres of World::markers if it is in front of them
  bool known_ids = true;                    ///< measurements have the ids of their landmarks; otherwise -1
  bool planar = false;                      ///< pitch is 0, and the range is the horizontal one
  double min_range = 0.2;                   ///< [m]
  double max_range = 10;                    ///< [m]
  double fov_yaw = 3.14159265358979323846;  ///< whole field of view [rad]
  double fov_pitch = 1.0;                   ///< [rad]
  double sigma_range = 0.05;                ///< [m]
  double sigma_angle = 0.01;                ///< of yaw and pitch [rad]
  double missed = 0;                        ///< part of the visible landmarks that are not reported
  double false_alarms = 0;                  ///< mean number of false measurements in an observation
  bool occlusion = true;                    ///< landmarks behind something are hidden
  static const base::OptionTable<RangeBearingOptions>& table();
};

/// Ranges and bearings of landmarks: CObservationBearingRange, in MRPT's convention (yaw to the left, pitch down).
/// There is no observation where nothing is seen. Measurements are in random order. The truth has one line for each
/// observation: "landmarks" are the names of the measured landmarks ("" for a false alarm), and "ids" their ids (-1 for
/// a false alarm).
class RangeBearing : public Sensor {
 public:
  /// Throws base::Error(out_of_range) if known_ids is set and two landmarks have the same id.
  RangeBearing(const RangeBearingOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  void refuseDoubleIds() const;
  struct Landmark {
    std::string name;
    int id;
    const Track* map_from_body;  // null: in_body is in the map
    Eigen::Vector3d in_body;
    bool is_marker;
  };
  std::vector<Landmark> visible(int k, std::vector<Eigen::Vector3d>& in_sensor) const;

  RangeBearingOptions options_;
  std::vector<Landmark> landmarks_;
};

}  // namespace omnimapper::sim
