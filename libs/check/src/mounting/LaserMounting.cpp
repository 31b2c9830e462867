// How the lasers of a robot are mounted, by the motion that their scans show beside that of the odometry.
#include <omnimapper/check/judge.h>

#include <algorithm>
#include <cmath>

#include "../Conclusions.h"
#include "../Format.h"
#include "SensorMounting.h"

namespace omnimapper::check {

namespace {

using mrpt::poses::CPose3D;
using State = Quantity::State;

class LaserMounting {
 public:
  LaserMounting(const LogFacts& facts, const QuantityKeys& corrected, std::string label, SensorMounting& mounting)
      : facts_(facts),
        corrected_(corrected),
        label_(std::move(label)),
        scans_(facts.scans.at(label_)),
        odometry_(usableOdometry(facts)),
        motion_(odometry_ ? motionOf(facts, label_, *odometry_) : nullptr),
        mounting_(mounting),
        pose_(scans_.base_from_sensor) {}

  void measure() {
    addAperture();
    addSense();
    addYawAndPlace();
    addFloor();
    if (usableLasers(facts_).front() == label_) addSweep();
    if (is_changed_) mounting_.sensors[label_].pose = pose_;
  }

 private:
  void say(const std::string& name, State state, const std::string& reason) {
    mounting_.quantities.push_back({label_, name, state, reason});
  }

  // Adds a number; `delta` is its change. Returns whether the declared one is to be replaced.
  bool add(const std::string& name, const std::string& unit, int decimals, double declared, const Measured& measured,
           bool is_wrong, const std::string& reason) {
    const bool is_corrected = is_wrong || corrected_.count({label_, name}) > 0;
    mounting_.quantities.push_back({label_, name, is_corrected ? State::corrected : State::as_declared, reason, unit,
                                    decimals, declared, measured});
    return is_corrected;
  }

  void addAperture() {
    const auto better = betterAperture(facts_, label_);
    if (!better) return;  // a declared aperture that is right needs no line
    mounting_.sensors[label_].aperture = *better;
    Quantity quantity{label_, "aperture", State::corrected, "its scans match best with it", "deg", 1};
    quantity.declared = degrees(scans_.aperture);
    quantity.measured.value = degrees(*better);
    mounting_.quantities.push_back(quantity);
  }

  // Whether the laser is upside down, or its beams run the other way round: both mirror the scans.
  void addSense() {
    constexpr std::size_t kFewest = 8;  // pairs of scans
    const std::string name = "sense of turning";
    const CPose3D flipped = pose_ + CPose3D(0, 0, 0, 0, 0, M_PI);
    std::size_t turning = 0;
    for (const auto& [odometry, facts] : facts_.odometry) {
      const auto* motion = motionOf(facts_, label_, odometry);
      if (motion) turning = std::max(turning, motion->turning);
      if (wrongTurnOf(facts_, label_, odometry) != Culprit::not_known) continue;
      is_mirrored_ = true;
      const std::string both = "where its scans turn left, " + check::quoted(odometry) + " turns right";
      say(name, State::two_causes, both);
      mounting_.two_causes.push_back(
          {check::quoted(label_) + ": " + both +
               ", and nothing else in the log tells which is wrong. Either the laser is upside down, or its beams run "
               "the other way round: then its roll is 180 deg more than declared, and without it the map is a mirror "
               "image. Or the wheels take left for right: then correct their driver; the laser is right as it is. "
               "Compare a map with the place: is what was on the left of the robot on its left?",
           "the laser is upside down or its beams run the other way round",
           label_,
           {flipped, {}, {}},
           {}});
      return;
    }
    if (!motion_) return say(name, State::not_determined, "there is no odometry that measures the motion");
    const auto culprit = wrongTurnOf(facts_, label_, *odometry_);
    if (culprit == Culprit::laser) {
      is_mirrored_ = is_changed_ = true;
      pose_ = flipped;
      mounting_.quantities.push_back({label_, name, State::corrected, "against odometry and a third sensor"});
      mounting_.quantities.back().words = "mirrored: upside down";
    } else if (turning < kFewest) {
      say(name, State::not_determined, "the robot turned in too few pairs of scans");
    } else {
      say(name, State::as_declared, "as " + check::quoted(*odometry_) + " turns");
      mounting_.quantities.back().words = scans_.isUpsideDown() ? "upside down" : "upright";
    }
  }

  // Why the motion does not show yaw and place; empty if it does.
  std::string whyNoMotion() const {
    if (!motion_) return "there is no odometry that measures the motion";
    if (is_mirrored_) return "scans and odometry turn against each other";
    if (scans_.sensor_pose_moves) return "the laser moves on the base";
    if (saturates(scans_))
      return "clipped readings pull the matches of its scans; limit the range first, as --check says";
    if (scans_.constant_ahead) return "beams on the floor pull the matches of its scans";
    if (!motion_->mounting)
      return "too few pairs of scans show a motion that " + check::quoted(motion_->odometry) + " measures, too";
    return "";
  }

  // Wheels that slip to one side in turns, or of which one is larger, look like a laser that is turned or displaced by
  // so little that nothing tells the two apart.
  void addYawAndPlace() {
    constexpr double kSureYaw = 3, kLeastYaw = 2;           // [deg]
    constexpr double kSurePlace = 0.05, kLeastPlace = 0.1;  // [m]
    constexpr double kTrust = 5;                            // standard deviations
    const auto why = whyNoMotion();
    if (!why.empty()) return say("yaw, x, y", State::not_determined, why);
    const auto& found = *motion_->mounting;
    const double yaw = degrees(found.yaw), yaw_sigma = degrees(found.yaw_sigma);
    const CPose3D declared = pose_;
    const std::string by = "by the motion of " + check::quoted(motion_->odometry);
    if (yaw_sigma >= kSureYaw) {
      say("yaw", State::not_determined,
          "it is known to " + fixed(yaw_sigma, 1) + " deg only: drive straight on longer");
    } else if (add("yaw", "deg", 2, degrees(declared.yaw()),
                   {degrees((CPose3D(0, 0, 0, found.yaw, 0, 0) + declared).yaw()), yaw_sigma},
                   std::abs(yaw) > std::max(kLeastYaw, kTrust * yaw_sigma), by)) {
      pose_ = CPose3D(0, 0, 0, found.yaw, 0, 0) + pose_;
      // The laser turns in its place, not about the base.
      pose_.x(declared.x());
      pose_.y(declared.y());
      is_changed_ = true;
    }
    if (found.position_sigma >= kSurePlace)
      return say("x, y", State::not_determined,
                 "they are known to " + fixed(found.position_sigma, 2) + " m only: turn on the spot for longer");
    const CPose3D place = CPose3D(found.x, found.y, 0, found.yaw, 0, 0) + declared;
    const bool is_wrong = std::hypot(place.x() - declared.x(), place.y() - declared.y()) >
                          std::max(kLeastPlace, kTrust * found.position_sigma);
    const bool moves_x = add("x", "m", 3, declared.x(), {place.x(), found.position_sigma}, is_wrong, by);
    const bool moves_y = add("y", "m", 3, declared.y(), {place.y(), found.position_sigma}, is_wrong, by);
    if (!moves_x && !moves_y) return;
    pose_.x(place.x());
    pose_.y(place.y());
    is_changed_ = true;
  }

  void addFloor() {
    // With the pitch of the first round its beams meet no floor that is not declared.
    if (!scans_.constant_ahead && corrected_.count({label_, "pitch"}) > 0) return;
    if (!scans_.constant_ahead)
      return say("pitch, roll, height", State::not_determined, "no beams ahead meet the floor");
    const auto& ahead = *scans_.constant_ahead;
    const std::string what = "what its beams meet ahead stays " + fixed(ahead.value, 2) + " m away";
    const auto pose = poseByFloor(scans_);
    if (!pose)
      return say("pitch, roll, height", State::not_determined,
                 what + ": the floor or a part of the robot; declare the laser's height to get its pitch");
    const double height = pose_.z(), slope = height / ahead.value;
    // The derivative of the angle whose sine is the height divided by the range.
    const double sigma = slope / ahead.value * ahead.sigma / std::sqrt(1 - slope * slope);
    add("pitch", "deg", 2, degrees(pose_.pitch()), {degrees(pose->pitch()), degrees(sigma)}, true,
        what + ", which is the floor if the laser is " + fixed(height, 2) + " m high as declared");
    say("height", State::not_determined, "the floor ahead shows only pitch or height");
    pose_.setFromValues(pose_.x(), pose_.y(), pose_.z(), pose->yaw(), pose->pitch(), pose->roll());
    is_changed_ = true;
  }

  void addSweep() {
    if (!scans_.sweep) return say("sweep", State::not_determined, "the robot turned too little or too evenly");
    const auto& sweep = *scans_.sweep;
    constexpr double kLeast = 0.004, kSigmas = 4;  // [s]
    if (!sweep.isWrong() &&
        std::abs(std::max(0.0, sweep.sweep) - sweep.declared) > std::max(kLeast, kSigmas * sweep.sigma))
      return say("sweep", State::not_determined,
                 "the turns of the odometry suggest " + fixed(sweep.sweep, 3) + " s, but its walls do not confirm it");
    const double measured = sweep.isInstant() && sweep.isWrong() ? 0 : std::max(0.0, sweep.sweep);
    if (add("sweep", "s", 4, sweep.declared, {measured, sweep.sigma}, sweep.isWrong(), "by turns"))
      mounting_.sweep = measured;
  }

  const LogFacts& facts_;
  const QuantityKeys& corrected_;
  std::string label_;
  const ScanFacts& scans_;
  std::optional<std::string> odometry_;
  const MotionFacts* motion_;
  SensorMounting& mounting_;
  CPose3D pose_;
  bool is_mirrored_ = false, is_changed_ = false;
};

}  // namespace

void addLasers(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting) {
  const auto lasers = usableLasers(facts);
  for (const auto& [label, scans] : facts.scans) {
    if (std::find(lasers.begin(), lasers.end(), label) == lasers.end())
      mounting.quantities.push_back({label, "pose", State::not_determined,
                                     isTilted(scans) ? "it scans a tilted plane" : "it has too few valid beams"});
  }
  for (const auto& label : lasers) LaserMounting(facts, corrected, label, mounting).measure();
}

}  // namespace omnimapper::check
