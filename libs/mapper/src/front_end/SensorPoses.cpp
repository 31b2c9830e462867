#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace omnimapper::mapper {

namespace {

using Track = std::map<base::Stamp, mrpt::poses::CPose3D>;

// Adds the pose of a line "stamp x y z qx qy qz qw". Returns what is wrong with the line, or an empty string.
std::string addLine(const std::string& line, Track& track) {
  std::istringstream fields(line);
  std::string stamp;
  double x, y, z, qx, qy, qz, qw;
  if (!(fields >> stamp >> x >> y >> z >> qx >> qy >> qz >> qw)) return "expected 'stamp x y z qx qy qz qw'";
  const Eigen::Quaterniond rotation(qw, qx, qy, qz);
  if (!(std::abs(rotation.norm() - 1) < 0.01)) return "the quaternion's length is not 1";
  const geometry::Se3 pose{rotation.normalized(), {x, y, z}};
  try {
    const bool is_new = track.emplace(base::parseUnix(stamp), geometry::toMrpt(pose)).second;
    return is_new ? "" : "this stamp occurs twice";
  } catch (const base::Error& error) {
    return error.what();
  }
}

// base_from_sensor over time.
Track readTrack(const std::string& path) {
  auto in = base::openInput(path, "file of sensor poses");
  Track track;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    const std::string problem = addLine(line, track);
    if (problem.empty()) continue;
    throw base::Error(base::ExitCode::unreadable_input, path + ":" + std::to_string(number) + ": " + problem);
  }
  if (track.empty()) throw base::Error(base::ExitCode::unreadable_input, path + ": contains no sensor pose");
  return track;
}

constexpr double kMostOffset = 1e6;  // [s] of a clock

// A section that gives an aperture or a clock but no part of a pose keeps the sensor pose of the observations.
bool givesPose(const base::ConfigSection& section) {
  const std::string keys[] = {"pose_x_m", "pose_y_m", "pose_z_m", "pose_yaw_deg", "pose_pitch_deg", "pose_roll_deg"};
  return std::any_of(std::begin(keys), std::end(keys), [&](const std::string& key) {
    std::string text;
    return section.find(key, text);
  });
}

}  // namespace

const base::OptionTable<SensorPoseOptions>& SensorPoseOptions::table() {
  using Options = SensorPoseOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label, "Sensor label of the observations that this section applies to.")
          .number("pose_x_m", &Options::x, {},
                  "x coordinate of the sensor in the base's frame (x forward, y left, z up). The frame's origin is the "
                  "point on the robot whose motion the odometry states.")
          .number("pose_y_m", &Options::y, {},
                  "y coordinate of the sensor in the base's frame (x forward, y left, z up). The frame's origin is the "
                  "point on the robot whose motion the odometry states.")
          .number("pose_z_m", &Options::z, {},
                  "z coordinate of the sensor in the base's frame (x forward, y left, z up). The frame's origin is the "
                  "point on the robot whose motion the odometry states.")
          .number("pose_yaw_deg", &Options::yaw, {}, "Orientation of the sensor in the base frame: yaw, about z.")
          .number("pose_pitch_deg", &Options::pitch, {}, "Orientation of the sensor in the base frame: pitch, about y.")
          .number("pose_roll_deg", &Options::roll, {},
                  "Orientation of the sensor in the base frame: roll, about x; 180 for a sensor mounted upside down.")
          .number("aperture_deg", &Options::aperture, {0, 360},
                  "Angle between the first and the last beam of the sensor's 2D scans; 0 keeps the aperture that the "
                  "scans report.")
          .number("clock_offset_s", &Options::clock_offset, {-kMostOffset, kMostOffset},
                  "Time that is added to every stamp of the sensor; it is negative if the stamps are late. Only for "
                  "logs: a live sensor has a key of the same name in the section of its driver.")
          .text("pose_file", &Options::file,
                "File of the sensor's poses on the base over time, for a sensor that moves on the base. Each line has "
                "a stamp [s], a position x y z [m] and a quaternion qx qy qz qw (TUM format).");
  return table;
}

SensorPoses::SensorPoses(const std::vector<std::string>& sections, const base::Config& config)
    : calibration_(camera::CameraCalibration::read(config)) {
  for (const auto& name : sections) {
    const auto options = config.section(name).read<SensorPoseOptions>();
    if (options.label.empty()) {
      throw base::Error(
          base::ExitCode::wrong_type,
          config.file() + ": [" + name + "] needs 'label = ...', the label of the sensor whose pose it gives");
    }
    if (options.aperture > 0) apertures_[options.label] = options.aperture;
    if (options.clock_offset != 0) clock_offsets_[options.label] = options.clock_offset;
    if (!options.file.empty()) {
      tracks_[options.label] = readTrack(options.file);
    } else if ((options.aperture == 0 && options.clock_offset == 0) || givesPose(config.section(name))) {
      tracks_[options.label] = {{base::Stamp(), mrpt::poses::CPose3D(options.x, options.y, options.z, options.yaw,
                                                                     options.pitch, options.roll)}};
    }
  }
}

std::optional<mrpt::poses::CPose3D> SensorPoses::find(const std::string& label, base::Stamp stamp) const {
  const auto found = tracks_.find(label);
  if (found == tracks_.end()) return std::nullopt;
  const Track& track = found->second;
  const auto after = track.lower_bound(stamp);
  if (after == track.begin()) return after->second;
  const auto before = std::prev(after);
  if (after == track.end()) return before->second;
  const double f = base::secondsBetween(before->first, stamp) / base::secondsBetween(before->first, after->first);
  const auto from = geometry::fromMrpt(before->second), to = geometry::fromMrpt(after->second);
  return geometry::toMrpt(plus(from, f * minus(to, from)));
}

mrpt::obs::CObservation::Ptr SensorPoses::applied(const mrpt::obs::CObservation::Ptr& observation) const {
  const auto pose = find(observation->sensorLabel, observation->timestamp);
  const auto aperture = apertures_.find(observation->sensorLabel);
  const bool is_calibrated = calibration_.isOf(observation->sensorLabel) &&
                             dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(observation.get()) != nullptr;
  if (!pose && aperture == apertures_.end() && !is_calibrated) return observation;
  auto copy = std::dynamic_pointer_cast<mrpt::obs::CObservation>(observation->duplicateGetSmartPtr());
  if (pose) copy->setSensorPose(*pose);
  auto* scan = dynamic_cast<mrpt::obs::CObservation2DRangeScan*>(copy.get());
  if (scan && aperture != apertures_.end()) scan->aperture = static_cast<float>(aperture->second);
  if (is_calibrated) calibration_.applyTo(dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(*copy));
  return copy;
}

source::SourceOptions sourceOptions(const base::Config& config) {
  auto options = source::readSourceOptions(config);
  options.clock_offsets = SensorPoses(config.section("mapper").read<EngineOptions>().sensors, config).clockOffsets();
  return options;
}

}  // namespace omnimapper::mapper
