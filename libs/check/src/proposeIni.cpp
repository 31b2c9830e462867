#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/check/proposeIni.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/motion/WheelOdometry.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "Conclusions.h"
#include "Format.h"

namespace omnimapper::check {

namespace {

// Sections of measurement plugins in our INIs that need a laser.
const std::vector<std::string>& pluginsOfLasers() {
  static const std::vector<std::string> sections{"loop_closure", "walls", "relations", "rooms"};
  return sections;
}

class Proposal {
 public:
  Proposal(const LogFacts& facts, const PluginLists& plugins)
      : facts_(facts),
        plugins_(plugins),
        lasers_(usableLasers(facts)),
        laser_odometry_(has(plugins.pose, kLaserOdometry)) {}

  std::vector<Setting> settings() {
    if (clockStands(facts_)) {
      proposeStamps();
      return std::move(settings_);  // without stamps the log shows nothing else
    }
    proposePlugins();
    proposeEngine();
    proposeSensors();
    proposeCalibration();
    proposePlanes();
    proposeLasers();
    proposeOdometry();
    return std::move(settings_);
  }

 private:
  static constexpr const char *kLaserOdometry = "scan_odometry", *kLaserLines = "laser_lines";

  static bool has(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  }

  static bool canBeNamed(const std::string& label) { return !label.empty() && base::fitsIni(label); }

  void set(const std::string& section, const std::string& key, const std::string& value, const std::string& reason) {
    settings_.push_back({section, key, value, reason});
  }

  // Proposes the list without `names`, if it has some of these and others too.
  void proposeWithout(const std::vector<std::string>& names, std::vector<std::string> list, const std::string& section,
                      const std::string& key, const std::string& reason) {
    const auto end = std::remove_if(list.begin(), list.end(), [&](const auto& name) { return has(names, name); });
    if (end == list.end() || (end == list.begin() && key != "extractors"))
      return;  // a map may be made without extractors
    list.erase(end, list.end());
    set(section, key, joined(list, ", "), reason);
  }

  void proposePlugins() {
    const bool is_blind = lasers_.empty(), is_driven = usableOdometry(facts_).has_value();
    std::vector<std::string> useless;
    if (is_blind) useless.push_back(kLaserOdometry);
    if (!is_driven) useless.push_back("odometry");
    const std::string no_laser = facts_.scans.empty() ? "there is no laser" : "no laser has scans that can be matched";
    const std::string no_odometry = facts_.odometry.empty() ? "there is no odometry" : "the odometry cannot be used";
    proposeWithout(useless, plugins_.pose, "mapper", "pose_plugins", is_driven ? no_laser : no_odometry);
    const bool shows_signs = std::any_of(facts_.sensors.begin(), facts_.sensors.end(), [](const auto& sensor) {
      return sensor.first.second == CLASS_ID(mrpt::obs::CObservationImage)->className ||
             sensor.first.second == CLASS_ID(mrpt::obs::CObservation3DRangeScan)->className;
    });
    std::vector<std::string> unfed =
        is_blind ? std::vector<std::string>{"laser_points", kLaserLines} : std::vector<std::string>();
    if (!shows_signs) unfed.push_back("signs");
    proposeWithout(unfed, plugins_.extractors, "perception", "extractors",
                   is_blind ? no_laser : "there are no pictures to read signs in");
    if (is_blind) proposeWithout(pluginsOfLasers(), plugins_.measurement, "mapper", "measurement_plugins", no_laser);
  }

  // The true duration of a step is not known, but only speeds depend on it.
  void proposeStamps() {
    set("source", "step_s", "0.1",
        "the stamps are missing or stand still; set it to the period of the sensor that is read most often");
  }

  void proposeEngine() {
    double lateness = 0;
    const auto clocks = clockOffsets(facts_);
    for (const auto& [sensor, stamps] : facts_.sensors) {
      if (clocks.count(sensor.first) == 0) lateness = std::max(lateness, stamps.lateness);
    }
    if (lateness > mapper::EngineOptions().window) {
      set("mapper", "window_s", fixed(std::ceil(11 * lateness) / 10, 1), "largest delay of an observation");
    }
    if (lasers_.size() > 1 && canBeNamed(lasers_.front())) {
      set("mapper", "reference_sensor", lasers_.front(), "the laser with the largest valid field of view");
    }
  }

  void proposeSensors() {
    std::map<std::string, std::vector<Setting>> changes;  // by label
    const auto change = [&](const std::string& label, const std::string& key, double value, int decimals,
                            const std::string& reason = "") {
      if (canBeNamed(label)) changes[label].push_back({"", key, fixed(value, decimals), reason});
    };
    // A section that has a key of a pose sets the whole pose.
    const auto change_pose = [&](const std::string& label, const mrpt::poses::CPose3D& pose) {
      if (!canBeNamed(label)) return;
      change(label, "pose_x_m", pose.x(), 2);
      change(label, "pose_y_m", pose.y(), 2);
      change(label, "pose_z_m", pose.z(), 2);
      changes[label].push_back({"", "pose_yaw_deg", angleText(pose.yaw()), ""});
      changes[label].push_back({"", "pose_pitch_deg", angleText(pose.pitch()), ""});
      changes[label].push_back({"", "pose_roll_deg", angleText(pose.roll()), ""});
    };
    for (const auto& laser : lasers_) {
      if (const auto pose = betterSensorPose(facts_, laser)) {
        change_pose(laser, *pose);
      } else if (const auto pose = poseByFloor(facts_.scans.at(laser))) {
        change_pose(laser, *pose);
      }
      if (const auto aperture = betterAperture(facts_, laser)) change(laser, "aperture_deg", degrees(*aperture), 1);
    }
    for (const auto& camera : facts_.cameras) {
      const auto pose = betterCameraPose(camera);
      if (pose && !blamesLaser(facts_, camera)) change_pose(camera.camera, *pose);
    }
    for (const auto& [label, offset] : clockOffsets(facts_))
      change(label, "clock_offset_s", offset + clockInIni(facts_, label), 3,
             "its clock differs from those of the other sensors");
    if (changes.empty()) return;
    auto sections = plugins_.sensors;
    std::vector<Setting> settings;
    for (const auto& [label, keys] : changes) {
      std::string section = sectionOf(label);
      while (has(sections, section)) section += "_";
      sections.push_back(section);
      settings.push_back({section, "label", label, ""});
      for (const auto& key : keys) settings.push_back({section, key.key, key.value, key.reason});
    }
    set("mapper", "sensors", joined(sections, ", "), "corrections of what the observations declare");
    settings_.insert(settings_.end(), settings.begin(), settings.end());
  }

  // One section holds the calibration of one camera. That of another camera in the INI is left alone.
  void proposeCalibration() {
    const auto& ini = facts_.ini;
    for (const auto& camera : facts_.cameras) {
      if (!canBeNamed(camera.camera) || (ini.has_calibration && ini.calibrated != camera.camera)) continue;
      std::vector<Setting> keys;
      const auto add = [&](const std::string& key, const std::string& value, const std::string& reason) {
        keys.push_back({"calibration", key, value, reason});
      };
      const bool is_of_camera = !blamesLaser(facts_, camera);
      const auto flag = [](bool is_set) { return is_set ? "true" : "false"; };
      if (camera.are == CameraFacts::Images::mirrored && is_of_camera)
        add("mirrored", flag(!ini.mirrored), "by the walls of the laser");
      if (camera.are == CameraFacts::Images::ranges && is_of_camera)
        add("depth_is_range", "true", "by the walls of the laser");
      if (hasWrongScale(camera))
        add("depth_scale", significant(camera.scale->value * ini.depth_scale), "by the walls of the laser");
      const bool has_size = addSizes(camera.camera, keys);
      const bool is_wrong = hasWrongFocalLength(camera);
      if (!has_size && (is_wrong || camera.has_negative_focal)) {
        const double factor = is_wrong ? camera.focal->value : 1;
        add("depth_fx_px", fixed(camera.fx * factor, 1), is_wrong ? "by the walls of the laser" : "positive");
        add("depth_fy_px", fixed(camera.fy * factor, 1), "");
      }
      if (addCalibration(camera.camera, keys)) return;
    }
    // Cameras that are compared with nothing.
    for (const auto& one : facts_.other_sizes) {
      if (!canBeNamed(one.label) || (ini.has_calibration && ini.calibrated != one.label)) continue;
      std::vector<Setting> keys;
      addSizes(one.label, keys);
      if (addCalibration(one.label, keys)) return;
    }
  }

  void proposePlanes() {
    for (const auto& camera : facts_.cameras) {
      const auto noise = neededNoise(facts_.ini, camera);
      if (!noise || !has(plugins_.extractors, "planes")) continue;
      set("planes", "noise_at_1m_m", fixed(*noise, 4), "its images are small or noisy");
      return;
    }
  }

  bool addCalibration(const std::string& label, const std::vector<Setting>& keys) {
    if (keys.empty()) return false;
    set("calibration", "label", label, "");
    settings_.insert(settings_.end(), keys.begin(), keys.end());
    return true;
  }

  // Adds the calibrations of images that are smaller or larger than those for which they were made. Returns whether
  // that of the depth images is among them. Where signs are read, the calibration of pictures is scaled anyway.
  bool addSizes(const std::string& label, std::vector<Setting>& keys) const {
    bool has_depth = false;
    for (const auto& one : facts_.other_sizes) {
      if (one.label != label || !one.isScaled() || (!one.is_depth && has(plugins_.extractors, "signs"))) continue;
      const std::string prefix = one.is_depth ? "depth_" : "picture_";
      keys.push_back({"calibration", prefix + "fx_px", fixed(one.fx, 1), "scaled to the size of the images"});
      keys.push_back({"calibration", prefix + "fy_px", fixed(one.fy, 1), ""});
      keys.push_back({"calibration", prefix + "cx_px", fixed(one.cx, 1), ""});
      keys.push_back({"calibration", prefix + "cy_px", fixed(one.cy, 1), ""});
      has_depth = has_depth || one.is_depth;
    }
    return has_depth;
  }

  void proposeLasers() {
    const bool can_be_named = std::all_of(lasers_.begin(), lasers_.end(), [](const std::string& laser) {
      return canBeNamed(laser) && laser.find(' ') == std::string::npos;  // a list is separated by blanks, too
    });
    if (can_be_named && !lasers_.empty() && lasers_.size() < facts_.scans.size()) {
      std::vector<std::string> labels;
      for (const auto& laser : lasers_) labels.push_back(perception::LaserPointsExtractor::labelOf(laser));
      set("loop_closure", "labels", joined(labels, ", "), "the other lasers have no scans that can be matched");
    }
    if (laser_odometry_ && !lasers_.empty() && facts_.scans.size() > 1 && canBeNamed(lasers_.front())) {
      set(kLaserOdometry, "label", lasers_.front(), "it uses one laser: the one with the largest valid field of view");
    }
    double limit = 0, median = 0;
    for (const auto& laser : lasers_) {
      const auto& scans = facts_.scans.at(laser);
      if (saturates(scans)) limit = std::max(limit, 0.99 * scans.longest);
      median = std::max(median, scans.median_range);
    }
    if (limit > 0) {
      set("laser_points", "max_range_m", fixed(limit, 2), "at longer ranges the beams met nothing");
      if (laser_odometry_) set(kLaserOdometry, "max_range_m", fixed(limit, 2), "as in [laser_points]");
      if (has(plugins_.extractors, kLaserLines))
        set(kLaserLines, "max_range_m", fixed(limit, 2), "as in [laser_points]");
    }
    for (const auto& laser : lasers_) {
      const auto& sweep = facts_.scans.at(laser).sweep;
      if (!laser_odometry_ || laser != lasers_.front() || !sweep || !sweep->isWrong()) continue;
      set(kLaserOdometry, "sweep_s", sweep->isInstant() ? "0" : fixed(sweep->sweep, 4),
          "time from the first beam of a scan to the last, by its turns");
    }
    if (median > 0 && median < 1.2) {
      set("trigger", "distance_m", "0.3", "the ranges are short, so key frames must be close together");
      set("trigger", "angle_deg", "15", "");
    }
  }

  void proposeOdometry() {
    const auto label = usableOdometry(facts_);
    const auto motions =
        motionsWith(facts_, label.value_or(facts_.odometry.empty() ? "" : facts_.odometry.begin()->first));
    if (!label) {
      constexpr double kStep = 0.3;     // [m] between key frames
      constexpr double kPeriod = 0.15;  // [s]
      const double speed = motions.empty() ? 0 : motions.front()->speed;
      if (speed * kPeriod > kStep) {
        set("trigger", "period_without_odometry_s", fixed(kStep / speed, 2),
            "the robot drives fast, so key frames must be frequent");
      }
      return;
    }
    // By default the mapper chooses an odometry as it goes, also when one pauses. Only much worse ones are excluded.
    if (isOneOdometryBest(facts_) && canBeNamed(*label)) {
      set("odometry", "label", *label, "of several odometries the one that agrees best with the scans");
      if (laser_odometry_) set(kLaserOdometry, "odometry_label", *label, "as in [odometry]");
    }
    // The noise hardly matters if this odometry only fills gaps of the laser's odometry.
    if (motions.empty() || (plugins_.odometry_is_fallback && laser_odometry_ && !lasers_.empty())) return;
    const motion::WheelOdometryOptions defaults;
    const auto propose = [&](const std::string& key, const std::optional<double>& measured, double value, double unit) {
      constexpr double kALot = 2;
      if (measured && *measured > kALot * value) {
        set("odometry", key, fixed(*measured / unit, unit < 1 ? 1 : 3), "noise measured against scan matching");
      }
    };
    const auto& motion = *motions.front();
    propose("position_noise_per_root_m", motion.position_noise_per_root_m, defaults.position_noise_per_root_m, 1);
    propose("yaw_noise_per_root_turn", motion.yaw_noise_per_root_turn, defaults.yaw_noise_per_root_turn, 1);
    propose("yaw_noise_per_root_m_deg", motion.yaw_noise_per_root_m, defaults.yaw_noise_per_root_m,
            base::option_text::kRadiansPerDegree);
  }

  const LogFacts& facts_;
  const PluginLists& plugins_;
  std::vector<std::string> lasers_;
  bool laser_odometry_;
  std::vector<Setting> settings_;
};

}  // namespace

bool canMeasure(const LogFacts& facts, const PluginLists& plugins) {
  if (!usableLasers(facts).empty()) return !plugins.measurement.empty();
  const auto& of_lasers = pluginsOfLasers();
  return std::any_of(plugins.measurement.begin(), plugins.measurement.end(), [&](const std::string& name) {
    return std::find(of_lasers.begin(), of_lasers.end(), name) == of_lasers.end();
  });
}

std::vector<Setting> proposeIni(const LogFacts& facts, const PluginLists& plugins) {
  return Proposal(facts, plugins).settings();
}

std::string toIni(const std::vector<Setting>& settings) {
  std::vector<std::string> sections;
  for (const auto& setting : settings) {
    if (std::find(sections.begin(), sections.end(), setting.section) == sections.end()) {
      sections.push_back(setting.section);
    }
  }
  if (sections.empty()) return "";
  std::string text = base::kWrittenFromALog + " by omnimapper-graphslam --check.\n";
  for (const auto& section : sections) {
    text += (section == sections.front() ? "[" : "\n[") + section + "]\n";
    for (const auto& setting : settings) {
      if (setting.section != section) continue;
      text += setting.key + " = " + setting.value + (setting.reason.empty() ? "" : "  ; " + setting.reason) + "\n";
    }
  }
  return text;
}

}  // namespace omnimapper::check
