#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/camera/CameraCalibration.h>
#include <omnimapper/source/SourceOptions.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// One sensor whose pose on the base, aperture or clock is given in the INI because its observations do not have it or
/// have a wrong one.
struct SensorPoseOptions {
  std::string label;                    ///< of the observations
  double x = 0, y = 0, z = 0;           ///< [m] base_from_sensor
  double yaw = 0, pitch = 0, roll = 0;  ///< [rad] MRPT's order: about z, then y, then x
  double aperture = 0;      ///< [rad] of its 2D scans, from the first beam to the last; 0: the scans' own aperture
  double clock_offset = 0;  ///< [s] that is added to its stamps
  std::string file;  ///< a TUM file of base_from_sensor over time, for a sensor that moves; overrides the pose above

  static const base::OptionTable<SensorPoseOptions>& table();
};

/// The poses of sensors on the base (thesis 5.3.3: static or dynamic transform from sensor to base), and the
/// calibration of depth cameras.
class SensorPoses {
 public:
  SensorPoses() = default;
  /// Reads one section of `config` for each name, and [calibration] if there is one. Throws base::Error if a section or
  /// a pose file is not valid.
  SensorPoses(const std::vector<std::string>& sections, const base::Config& config);

  /// base_from_sensor for an observation, if the INI gives it. It is interpolated between the stamps of a pose file;
  /// before the first and after the last stamp, the nearest pose is used.
  std::optional<mrpt::poses::CPose3D> find(const std::string& label, base::Stamp stamp) const;

  /// Time [s] to add to all stamps of a sensor, by label, for source::SourceOptions. applied() does not add it.
  const std::map<std::string, double>& clockOffsets() const { return clock_offsets_; }

  /// The observation itself if the INI gives nothing for it, else a copy with the INI's pose, aperture and calibration.
  mrpt::obs::CObservation::Ptr applied(const mrpt::obs::CObservation::Ptr& observation) const;

 private:
  using Track = std::map<base::Stamp, mrpt::poses::CPose3D>;
  std::map<std::string, Track> tracks_;  // a static pose is a track with one entry
  std::map<std::string, double> clock_offsets_;
  std::map<std::string, double> apertures_;  // [rad] of the sensors for which the INI gives one
  camera::CameraCalibration calibration_;
};

/// The section [source], with the clocks of the sensors that `[mapper] sensors` names.
source::SourceOptions sourceOptions(const base::Config& config);

}  // namespace omnimapper::mapper
