#include "SensorFindings.h"

#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>

#include "Conclusions.h"
#include "Format.h"

namespace omnimapper::check {

namespace {

class ClockJudge {
 public:
  explicit ClockJudge(const LogFacts& facts) : facts_(facts), offsets_(clockOffsets(facts)) {}

  std::vector<Finding> findings() {
    for (const auto& motion : facts_.motions) judge(motion.odometry, motion.laser, motion.clock, false);
    for (const auto& one : facts_.gyroscopes) judge(one.gyroscope, one.laser, one.clock, false);
    for (const auto& camera : facts_.cameras) {
      if (camera.clock && std::abs(camera.clock->value) > kRollingShutter)
        judge(camera.camera, camera.laser, ClockFacts{camera.clock->value, camera.clock->sigma, 0, false}, true);
    }
    return std::move(findings_);
  }

 private:
  void judge(const std::string& sensor, const std::string& other, const std::optional<ClockFacts>& clock,
             bool is_camera) {
    if (!clock) return;
    const std::string who = quoted(sensor) + " and " + quoted(other) + ": ";
    if (clock->isWrong()) {
      constexpr double kMuch = 0.1;  // [s] in which a robot that turns is elsewhere by centimetres and degrees
      const auto& wrong = offsets_.count(sensor) > 0 ? sensor : other;
      const auto remedy = offsets_.find(wrong);
      const bool is_corrected = !is_camera && !isBeyond(*clock, kCorrectedOffset);
      const std::string what = remedy == offsets_.end()
                                   ? "; set clock_offset_s for one of them in [mapper] sensors"
                                   : "; set clock_offset_s = " + fixed(remedy->second + clockInIni(facts_, wrong), 3) +
                                         " for " + quoted(wrong) + " in [mapper] sensors";
      const bool spoils = is_camera && std::abs(clock->offset) > kMuch;
      findings_.push_back({is_corrected ? Weight::note
                           : spoils     ? Weight::problem
                                        : Weight::warning,
                           who + "their clocks differ: for the same turn the stamps of " + quoted(sensor) + " are " +
                               fixed(std::abs(clock->offset), 3) + " +- " + fixed(std::max(0.001, clock->sigma), 3) +
                               " s " + (clock->offset > 0 ? "later" : "earlier") +
                               (is_corrected ? "; laser odometry finds and corrects so small an offset" : what),
                           !is_corrected});
    }
    if (clock->drift != 0) {
      findings_.push_back({Weight::warning,
                           who + "their clocks drift apart by " + fixed(1e3 * std::abs(clock->drift), 2) +
                               " s in 1000 s; a constant clock_offset_s does not correct this: map the log in parts "
                               "([source] start_s, end_s), or synchronize the clocks",
                           false});
    }
  }

  const LogFacts& facts_;
  std::map<std::string, double> offsets_;
  std::vector<Finding> findings_;
};

class CameraJudge {
 public:
  CameraJudge(const LogFacts& facts, const CameraFacts& camera)
      : ini_(facts.ini),
        camera_(camera),
        blames_laser_(blamesLaser(facts, camera)),
        who_(quoted(camera.camera) + ": "),
        by_walls_(", by the walls that " + quoted(camera.laser) + " sees") {}

  std::vector<Finding> findings() {
    judgeImages();
    judgeScale();
    judgeFocalLength();
    judgePose();
    judgeHeight();
    judgeUnits();
    judgeSize();
    return std::move(findings_);
  }

 private:
  void add(Weight weight, const std::string& text) { findings_.push_back({weight, who_ + text, true}); }

  void judgeImages() {
    if (blames_laser_) return;
    if (camera_.are == CameraFacts::Images::mirrored)
      add(Weight::problem,
          "its images are mirror images: planes lie on walls of the laser only if left and right are exchanged; set "
          "[calibration] mirrored = " +
              std::string(ini_.mirrored ? "false" : "true"));
    if (camera_.are == CameraFacts::Images::ranges)
      add(Weight::problem,
          "its depth images hold distances from the camera instead of depths: only then its planes are flat and lie on "
          "walls of the laser; set [calibration] depth_is_range = true");
  }

  void judgeScale() {
    if (hasWrongScale(camera_)) {
      const bool much = std::abs(std::log(camera_.scale->value)) > 2 * kWrongScale;
      add(much ? Weight::problem : Weight::warning,
          "the true depths are " + significant(camera_.scale->value) + " times those in the log" + by_walls_ +
              "; set [calibration] depth_scale = " + significant(camera_.scale->value * ini_.depth_scale));
    } else if (const auto scale = scaleByHeight(camera_); scale && !camera_.scale) {
      add(Weight::problem, "the floor appears " + significant(camera_.height->value) +
                               " m below the camera, but its pose declares " + significant(camera_.declared.z()) +
                               " m: either the depths have another unit (then set [calibration] depth_scale = " +
                               significant(*scale * ini_.depth_scale) +
                               ") or the declared height is wrong; measure the height");
    }
  }

  void judgeFocalLength() {
    if (!hasWrongFocalLength(camera_)) return;
    add(Weight::problem, "the true focal length is " + fixed(camera_.focal->value, 2) + " times the declared one" +
                             by_walls_ + "; set depth_fx_px = " + fixed(camera_.fx * camera_.focal->value, 1) +
                             " and depth_fy_px = " + fixed(camera_.fy * camera_.focal->value, 1) +
                             " in [calibration]; omnimapper-calibrate measures them more exactly");
  }

  void judgePose() {
    constexpr double kMuchTilt = 6, kMuchYaw = 4;  // [deg]
    const bool is_tilted = isTilted(camera_), is_turned = isTurned(camera_) && !blames_laser_;
    if (!camera_.pose || (!is_tilted && !is_turned)) return;
    const bool much = (is_tilted && degrees(camera_.tilt) > kMuchTilt) ||
                      (is_turned && std::abs(degrees(camera_.yaw->value)) > kMuchYaw);
    const double turned =
        geometry::fromMrpt(camera_.declared).rotation.angularDistance(geometry::fromMrpt(*camera_.pose).rotation);
    std::string how;
    if (is_turned && is_tilted) {
      how = "is rotated by " + fixed(degrees(turned), 1) + " deg, by the floor that it sees and" + by_walls_.substr(1);
    } else if (is_turned) {
      how = "is turned by " + fixed(degrees(camera_.yaw->value), 1) + " +- " + fixed(degrees(camera_.yaw->sigma), 1) +
            " deg in yaw" + by_walls_;
    } else {
      how = "is tilted by " + fixed(degrees(camera_.tilt), 1) + " deg, by the floor that it sees";
    }
    add(much ? Weight::problem : Weight::warning, how + ", against its declared pose; set " +
                                                      poseKeys(*betterCameraPose(camera_)) +
                                                      " for it in [mapper] sensors");
  }

  void judgeHeight() {
    if (!hasWrongHeight(camera_)) return;
    const auto height = *trueHeight(camera_);
    add(Weight::warning, "its pose declares a height of " + fixed(camera_.declared.z(), 2) + " m, but it is " +
                             fixed(height.value, 2) + " +- " + fixed(height.sigma, 2) +
                             " m over the floor that it sees" + by_walls_ + " at the right scale; set pose_z_m " +
                             fixed(height.value, 2) +
                             " for it in [mapper] sensors, if the base's origin is on the floor");
  }

  void judgeUnits() {
    constexpr double kFar = 15, kNear = 0.25;  // [m] medians that no camera on a robot indoors has
    if (camera_.scale || scaleByHeight(camera_) || camera_.median_depth <= 0) return;
    const bool is_far = camera_.median_depth > kFar;
    if (!is_far && camera_.median_depth > kNear) return;
    add(Weight::problem,
        "half of its depths are " + std::string(is_far ? "over " : "under ") + significant(camera_.median_depth) +
            " m: are they in another unit? Set [calibration] depth_scale, for example " + (is_far ? "0.001" : "1000"));
  }

  // Small images have more noise in a pixel than the extractor expects, or show too little of each surface.
  void judgeSize() {
    const std::string size =
        std::to_string(camera_.columns) + " x " + std::to_string(camera_.rows) + " px, or depths with much noise";
    if (const auto noise = neededNoise(ini_, camera_)) {
      add(Weight::warning, "its images show surfaces only with " + fixed(camera_.noise, 0) +
                               " times the noise that the PlaneExtractor assumes, because they are small, " + size +
                               "; set [planes] noise_at_1m_m = " + fixed(*noise, 4));
    } else if (camera_.images >= kFewestImages && 4 * camera_.planes < camera_.images) {
      findings_.push_back({Weight::warning,
                           who_ + "its images give no surfaces: " + counted(camera_.planes, "plane") + " in " +
                               counted(camera_.images, "image") + " of " + size,
                           false});
    }
  }

  static constexpr std::size_t kFewestImages = 8;

  const IniFacts& ini_;
  const CameraFacts& camera_;
  bool blames_laser_;
  std::string who_, by_walls_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> clockFindings(const LogFacts& facts) {
  return ClockJudge(facts).findings();
}

std::vector<Finding> imageSizeFindings(const LogFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& one : facts.other_sizes) {
    const auto size = [](double columns, double rows) { return fixed(columns, 0) + " x " + fixed(rows, 0) + " px"; };
    const std::string kind = one.is_depth ? "depth" : "picture", prefix = kind + "_";
    const std::string remedy =
        one.isScaled() ? "set " + prefix + "fx_px = " + fixed(one.fx, 1) + ", " + prefix +
                             "fy_px = " + fixed(one.fy, 1) + ", " + prefix + "cx_px = " + fixed(one.cx, 1) + " and " +
                             prefix + "cy_px = " + fixed(one.cy, 1) + " in [calibration]" +
                             (one.is_depth ? "" : ", unless signs are read, which scales the calibration itself") +
                             ", or record the calibration of the images that are sent"
                       : std::string("they are cut or stretched: record the calibration of the images that are sent");
    findings.push_back({Weight::problem,
                        quoted(one.label) + ": its " + (one.is_depth ? "depth" : "colour") + " images have " +
                            size(one.columns, one.rows) + ", but their calibration is that of images of " +
                            size(one.calibrated_columns, one.calibrated_rows) + "; " + remedy,
                        true});
  }
  return findings;
}

std::vector<Finding> cameraFindings(const LogFacts& facts) {
  std::vector<Finding> findings;
  for (const auto& camera : facts.cameras) {
    const auto some = CameraJudge(facts, camera).findings();
    findings.insert(findings.end(), some.begin(), some.end());
  }
  return findings;
}

}  // namespace omnimapper::check
