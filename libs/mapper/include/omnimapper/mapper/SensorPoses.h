#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/perception/CameraCalibration.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// One sensor whose place on the base, or whose aperture, the INI tells, because its observations do not or tell it
/// wrong.
struct SensorPoseOptions {
  std::string label;                    ///< of the observations
  double x = 0, y = 0, z = 0;           ///< [m] base_from_sensor
  double yaw = 0, pitch = 0, roll = 0;  ///< [rad] MRPT's order: about z, then y, then x
  double aperture = 0;  ///< [rad] of its 2D scans, from the first beam to the last; 0: as the scans have it
  std::string file;     ///< a TUM file of base_from_sensor over time, for a sensor that moves; overrides the pose above

  static const base::OptionTable<SensorPoseOptions>& table();
};

/// Where sensors are on the base (thesis 5.3.3: static or dynamic transform from sensor to base), and how its cameras
/// with depths are calibrated.
class SensorPoses {
 public:
  SensorPoses() = default;
  /// One section of `config` for each name, and [calibration], if it is there. Throws base::Error if a section or a
  /// pose file does not fit.
  SensorPoses(const std::vector<std::string>& sections, const base::Config& config);

  /// base_from_sensor for an observation, if the INI tells it; between stamps of a file it is interpolated, beyond
  /// its ends the nearest holds.
  std::optional<mrpt::poses::CPose3D> find(const std::string& label, base::Stamp stamp) const;

  /// The observation itself where the INI tells nothing, else a copy with that sensor pose, aperture and calibration.
  mrpt::obs::CObservation::Ptr applied(const mrpt::obs::CObservation::Ptr& observation) const;

 private:
  using Track = std::map<base::Stamp, mrpt::poses::CPose3D>;
  std::map<std::string, Track> tracks_;      // a static pose is a track of one
  std::map<std::string, double> apertures_;  // [rad] where one is told
  perception::CameraCalibration calibration_;
};

}  // namespace omnimapper::mapper
