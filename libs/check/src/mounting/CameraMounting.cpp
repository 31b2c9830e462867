// How depth cameras are mounted, by the floor that they see and the walls that a laser sees, and the clocks of all.
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>

#include "../Conclusions.h"
#include "../Format.h"
#include "SensorMounting.h"

namespace omnimapper::check {

namespace {

using mrpt::poses::CPose3D;
using State = Quantity::State;

class CameraMounting {
 public:
  CameraMounting(const LogFacts& facts, const QuantityKeys& corrected, const CameraFacts& camera,
                 SensorMounting& mounting)
      : facts_(facts),
        corrected_(corrected),
        camera_(camera),
        mounting_(mounting),
        blames_laser_(blamesLaser(facts, camera)),
        by_walls_("by the walls that " + check::quoted(camera.laser) + " sees") {}

  void measure() {
    addImages();
    addRotation();
    addHeight();
    addScale();
    addFocalLength();
    say("x, y", State::not_determined, "no wall shows them to less than some centimetres");
    if (!keys_.isEmpty()) mounting_.cameras[camera_.camera] = keys_;
  }

 private:
  void say(const std::string& name, State state, const std::string& reason, const std::string& words = "") {
    mounting_.quantities.push_back({camera_.camera, name, state, reason});
    mounting_.quantities.back().words = words;
  }

  bool add(const std::string& name, const std::string& unit, int decimals, double declared, const Measured& measured,
           bool is_wrong, const std::string& reason) {
    const bool is_corrected = is_wrong || corrected_.count({camera_.camera, name}) > 0;
    mounting_.quantities.push_back({camera_.camera, name, is_corrected ? State::corrected : State::as_declared, reason,
                                    unit, decimals, declared, measured});
    return is_corrected;
  }

  // Why the walls of a laser do not show what they usually show; empty if they do.
  std::string whyNoWalls() const {
    if (camera_.laser.empty()) return "there is no laser whose walls its planes could lie on";
    if (!camera_.yaw)
      return "only " + std::to_string(camera_.matched) + " of its " + counted(camera_.walls, "upright plane") +
             " lie on walls of " + check::quoted(camera_.laser);
    return "";
  }

  void addImages() {
    using Images = CameraFacts::Images;
    if (camera_.are == Images::as_declared) return;
    const bool are_mirrored = camera_.are == Images::mirrored;
    const std::string name = "images", words = are_mirrored ? "mirrored" : "distances instead of depths";
    if (blames_laser_) {
      say(name, State::two_causes,
          "they are " + words + ", or " + check::quoted(camera_.laser) + " is mounted otherwise", words);
      return;
    }
    say(name, State::corrected, by_walls_, words);
    (are_mirrored ? keys_.mirrored : keys_.depth_is_range) = are_mirrored ? !facts_.ini.mirrored : true;
  }

  void addRotation() {
    constexpr double kLeastTilt = 0.2, kLeastYaw = 0.2;  // [deg]
    constexpr double kSigmas = 4;
    const auto why = whyNoWalls();
    const bool has_yaw = why.empty() && !blames_laser_;
    const double yaw = has_yaw ? camera_.yaw->value : 0;
    const CPose3D declared = camera_.declared;
    // The level pose at the declared yaw.
    CPose3D level = declared;
    if (camera_.pose && camera_.height) {
      level = CPose3D(0, 0, 0, camera_.yaw ? -camera_.yaw->value : 0, 0, 0) + *camera_.pose;
      level.setFromValues(declared.x(), declared.y(), declared.z(), level.yaw(), level.pitch(), level.roll());
    }
    const CPose3D found = turned(level, yaw);
    bool is_level_wrong = false;
    if (camera_.height) {
      const double sigma = degrees(camera_.tilt_sigma);
      const bool is_wrong = degrees(camera_.tilt) > std::max(kLeastTilt, kSigmas * sigma);
      const std::string by = "by the floor in " + counted(camera_.floor_images, "image");
      is_level_wrong = add("pitch", "deg", 2, degrees(declared.pitch()), {degrees(found.pitch()), sigma}, is_wrong, by);
      // About the optical axis of a camera that looks down, roll and yaw are nearly the same.
      const double slope = std::max(0.05, std::cos(found.pitch()));
      add("roll", "deg", 2, degrees(declared.roll()), {degrees(found.roll()), sigma / slope}, is_level_wrong, by);
    } else {
      say("pitch, roll", State::not_determined, "no level surface is in a third of its images");
    }
    bool is_yaw_wrong = false;
    if (has_yaw) {
      is_yaw_wrong = add("yaw", "deg", 2, degrees(declared.yaw()), {degrees(found.yaw()), degrees(camera_.yaw->sigma)},
                         camera_.yaw->differs(0, kLeastYaw * base::option_text::kRadiansPerDegree), by_walls_);
    } else {
      say("yaw", State::not_determined,
          why.empty() ? check::quoted(camera_.laser) + ", against which it is measured, is itself in doubt" : why);
    }
    if (is_level_wrong || is_yaw_wrong)
      mounting_.sensors[camera_.camera].pose = turned(is_level_wrong ? level : declared, is_yaw_wrong ? yaw : 0);
  }

  // The camera turned in its place.
  static CPose3D turned(const CPose3D& pose, double yaw) {
    const CPose3D turned = CPose3D(0, 0, 0, yaw, 0, 0) + pose;
    return {pose.x(), pose.y(), pose.z(), turned.yaw(), turned.pitch(), turned.roll()};
  }

  void setHeight(SensorKeys& keys, double height) const {
    if (!keys.pose) keys.pose = camera_.declared;
    keys.pose->z(height);
  }

  void addHeight() {
    constexpr double kLeast = 0.01, kLeastAlone = 0.05;  // [m]
    const double declared = camera_.declared.z();
    if (!camera_.height) return say("height", State::not_determined, "no level surface is in a third of its images");
    if (const auto height = trueHeight(camera_)) {
      if (add("height", "m", 3, declared, *height, height->differs(declared, kLeast),
              "over the floor that it sees, by depths of the right scale"))
        setHeight(mounting_.sensors[camera_.camera], height->value);
      return;
    }
    // Without walls of known size the floor shows height and scale together.
    if (!camera_.height->differs(declared, kLeastAlone)) {
      add("height", "m", 3, declared, *camera_.height, false,
          "over the floor that it sees, if its depths are in metres");
      return;
    }
    const std::string both = "the floor appears " + fixed(camera_.height->value, 2) + " m below the camera, " +
                             fixed(declared, 2) + " m are declared";
    say("height", State::two_causes, both);
    TwoCauses causes{
        check::quoted(camera_.camera) + ": " + both +
            ". Either it is mounted at another height, or its depths have another unit (then set depth_scale "
            "in [calibration]). Measure its height",
        "the camera is at that height",
        camera_.camera,
        {},
        {}};
    setHeight(causes.keys, camera_.height->value);
    mounting_.two_causes.push_back(causes);
  }

  void addScale() {
    constexpr double kLeast = 0.004;
    const auto why = whyNoWalls();
    if (!camera_.scale) return say("depth scale", State::not_determined, why);
    const double before = facts_.ini.depth_scale;
    const Measured scale{camera_.scale->value * before, camera_.scale->sigma * before};
    if (add("depth scale", "", 4, before, scale, camera_.scale->differs(1, kLeast), by_walls_))
      keys_.depth_scale = scale.value;
  }

  void addFocalLength() {
    constexpr double kLeast = 0.01;
    if (!camera_.focal) return say("focal length", State::not_determined, whyNoWalls());
    const auto& focal = *camera_.focal;
    const bool is_wrong = focal.differs(1, kLeast) || camera_.has_negative_focal;
    const Measured fx{camera_.fx * focal.value, camera_.fx * focal.sigma};
    if (!add("focal length", "px", 1, camera_.has_negative_focal ? -camera_.fx : camera_.fx, fx, is_wrong, by_walls_))
      return;
    keys_.fx = fx.value;
    keys_.fy = camera_.fy * focal.value;
  }

  const LogFacts& facts_;
  const QuantityKeys& corrected_;
  const CameraFacts& camera_;
  SensorMounting& mounting_;
  bool blames_laser_;
  std::string by_walls_;
  CalibrationKeys keys_;
};

}  // namespace

void addCameras(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting) {
  for (const auto& [sensor, stamps] : facts.sensors) {
    const auto& [label, class_name] = sensor;
    if (class_name != CLASS_ID(mrpt::obs::CObservation3DRangeScan)->className) continue;
    const auto camera = std::find_if(facts.cameras.begin(), facts.cameras.end(),
                                     [&name = label](const CameraFacts& one) { return one.camera == name; });
    if (camera == facts.cameras.end()) {
      mounting.quantities.push_back({label, "pose", State::not_determined,
                                     usableOdometry(facts) ? "it has no depth images that can be used"
                                                           : "there is no odometry that measures the motion"});
      continue;
    }
    CameraMounting(facts, corrected, *camera, mounting).measure();
  }
}

}  // namespace omnimapper::check
