#include <omnimapper/base/Names.h>
#include <omnimapper/check/fittingInis.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/motion/WheelOdometry.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "Conclusions.h"
#include "Format.h"
#include "SensorFindings.h"

namespace omnimapper::check {

namespace {

class Judge {
 public:
  explicit Judge(const LogFacts& facts) : facts_(facts) {}

  std::vector<Finding> findings() {
    for (const auto& [sensor, stamps] : facts_.sensors) judgeStamps(sensor.first, stamps);
    for (const auto& [label, scans] : facts_.scans) judgeScans(label, scans);
    judgeUnusable();
    judgeLabels();
    judgeContent();
    judgeOdometry();
    judgePairs();
    for (const auto& some : {clockFindings(facts_), imageSizeFindings(facts_), cameraFindings(facts_)})
      findings_.insert(findings_.end(), some.begin(), some.end());
    judgePoses();
    judgeLevels();
    for (const auto& laser : usableLasers(facts_)) judgeSensorPose(laser);
    std::stable_sort(findings_.begin(), findings_.end(),
                     [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
    return std::move(findings_);
  }

 private:
  void add(Weight weight, const std::string& text) { findings_.push_back({weight, text, false}); }
  void contradict(Weight weight, const std::string& text) { findings_.push_back({weight, text, true}); }
  std::string sinceStart(base::Stamp stamp) const {
    base::Stamp first = stamp;
    for (const auto& [sensor, stamps] : facts_.sensors) {
      if (base::isValid(stamps.first)) first = std::min(first, stamps.first);
    }
    return fixed(base::secondsBetween(first, stamp), 1) + " s after the start of the log";
  }

  void judgeContent() {
    const auto inis = fittingInis(facts_);
    const auto is_sure = [](const FittingIni& ini) { return !ini.is_a_guess; };
    const bool is_mappable = std::any_of(inis.begin(), inis.end(), is_sure);
    if (!facts_.scans.empty() && usableLasers(facts_).empty()) {
      add(is_mappable ? Weight::warning : Weight::problem,
          "no laser has scans that can be matched: they are empty, lack valid beams, or their plane is tilted against "
          "the floor");
    } else if (!is_mappable && inis.empty()) {
      add(Weight::problem,
          "there is nothing to map: the log has no 2D scans and no depth images. Planes and point clouds need odometry "
          "or poses beside them; ranges and bearings, and pictures of markers, need odometry");
    } else if (!is_mappable) {
      add(Weight::warning,
          "there may be nothing to map: the pictures can be used only if they show ArUco markers or door signs");
    }
  }

  void judgeStamps(const std::string& label, const StampFacts& stamps) {
    const std::string who = quoted(label) + ": ";
    const auto weigh = [&](std::size_t bad) { return 2 * bad > stamps.count ? Weight::problem : Weight::warning; };
    if (stamps.no_stamp > 0) {
      add(weigh(stamps.no_stamp),
          who + std::to_string(stamps.no_stamp) + " of " + counted(stamps.count, "observation") +
              " are without a stamp and are left out of the map; " +
              (clockStands(facts_)
                   ? "set [source] step_s to the period of the sensor that is read most often, to make stamps"
                   : "record this sensor with stamps"));
    }
    if (stamps.repeated > 0) {
      add(weigh(stamps.repeated),
          who + "a stamp is repeated by the next observation " + counted(stamps.repeated, "time") +
              "; only the first one of each stamp is used" +
              (clockStands(facts_) ? ". The stamps of all sensors stand still: set [source] step_s to the period of "
                                     "the sensor that is read most often, to get new ones"
                                   : ""));
    }
    if (stamps.jumps > 0) {
      add(Weight::problem, who + "the clock jumps " + counted(stamps.jumps, "time") + ", by up to " +
                               fixed(stamps.largest_jump, 0) +
                               " s; map the parts before and after it separately ([source] start_s, end_s)");
    }
    if (stamps.backward > 0) {
      add(Weight::warning,
          who + "stamps run backwards " + counted(stamps.backward, "time") + ", by less than 10 s each");
    }
    if (stamps.lateness > mapper::EngineOptions().window && !isLateByItsClock(label, stamps.lateness)) {
      add(Weight::warning, who + "comes up to " + fixed(stamps.lateness, 1) +
                               " s after later stamps of other sensors; set [mapper] window_s to more than that");
    }
    if (stamps.gaps > stamps.rests) {
      constexpr double kLong = 5;  // [s] a robot may have gone far
      add(stamps.longest_drive > kLong ? Weight::warning : Weight::note,
          who + counted(stamps.gaps - stamps.rests, "gap") + " in which the robot may have moved, the longest of " +
              fixed(stamps.longest_drive, 1) + " s (the usual interval is " + fixed(stamps.period, 3) + " s)");
    }
    if (stamps.rests > 0) {
      add(Weight::note,
          who + counted(stamps.rests, "gap") +
              " in which the robot moved by less than 1.5 m and turned by less than 1 rad according to odometry");
    }
  }

  // Whether observations come after later stamps of others because their clock differs.
  bool isLateByItsClock(const std::string& label, double lateness) const {
    const auto offsets = clockOffsets(facts_);
    const auto found = offsets.find(label);
    return found != offsets.end() && found->second > 0 && lateness < found->second + mapper::EngineOptions().window;
  }

  void judgeLabels() {
    std::set<std::string> labels;
    for (const auto& [sensor, stamps] : facts_.sensors) labels.insert(sensor.first);
    for (const auto& label : labels) {
      if (base::fitsIni(label)) continue;
      add(Weight::warning, quoted(label) +
                               ": no INI can name this label, because it holds a comma, a '$', a comment or characters "
                               "that cannot be printed; no settings are proposed for it. Record this sensor with "
                               "another label");
    }
  }

  // A sensor most of whose observations cannot be used does not work, even if the others are good.
  void judgeUnusable() {
    if (facts_.missing_images > 0) {
      add(Weight::warning, counted(facts_.missing_images, "observation") +
                               " left out because an external file cannot be read, the first " +
                               facts_.first_missing_image +
                               "; put the files there, or set their folder in [source] images_folder");
    }
    for (const auto& [key, left_out] : facts_.unusable) {
      const auto& [label, reason] = key;
      std::size_t usable = 0;
      for (const auto& [sensor, stamps] : facts_.sensors) {
        if (sensor.first == label) usable += stamps.count;
      }
      add(2 * left_out.observations > usable ? Weight::problem : Weight::warning,
          quoted(label) + ": " + counted(left_out.observations, "observation") + " left out because " + reason +
              ", the first " + sinceStart(left_out.first_stamp));
    }
  }

  void judgeScans(const std::string& label, const ScanFacts& scans) {
    const std::string who = quoted(label) + ": ";
    const auto part = [&](std::size_t count) { return std::to_string(count) + " of " + counted(scans.scans, "scan"); };
    const auto weigh = [&](std::size_t bad) { return 2 * bad > scans.scans ? Weight::problem : Weight::warning; };
    if (scans.empty > 0) add(weigh(scans.empty), who + part(scans.empty) + " have no beams");
    if (scans.beams == 1) add(Weight::problem, who + "its scans have one beam and cannot be matched");
    if (scans.blind > 0) {
      std::string how;
      if (scans.all_zero > 0) how += ", " + std::to_string(scans.all_zero) + " of them all zeros";
      if (scans.all_maximum > 0) how += ", " + std::to_string(scans.all_maximum) + " of them all at maximum range";
      add(weigh(scans.blind), who + part(scans.blind) + " have no valid beam" + how);
    }
    if (10 * scans.repeated > scans.scans) {
      add(weigh(scans.repeated),
          who + part(scans.repeated) + " are exactly equal to the one before: is the sensor stuck?");
    }
    if (scans.other_beams > 0)
      add(Weight::note, who + part(scans.other_beams) + " have another number of beams than the first one, " +
                            std::to_string(scans.fewest_beams) + " to " + std::to_string(scans.most_beams));
    if (scans.clockwise == scans.scans - scans.empty && scans.clockwise > 0) {
      add(Weight::note, who + "its beams run clockwise, as its scans declare, and are used so");
    } else if (scans.clockwise > 0) {
      add(Weight::warning, who + "the beams of " + part(scans.clockwise) +
                               " run clockwise, those of the others counter-clockwise: do two lasers share the label?");
    }
    if (saturates(scans)) {
      contradict(Weight::problem, who + percent(scans.longest_share) + " of the valid beams measure exactly " +
                                      fixed(scans.longest, 2) +
                                      " m: probably nothing came back, but they are marked as valid; limit the range "
                                      "(max_range_m in [laser_points], [scan_odometry] and [laser_lines])");
    }
    constexpr double kSome = 0.0005;  // of the beams
    if (scans.single_share > kSome) {
      add(Weight::note, who + percent(scans.single_share) +
                            " of the beams are single beams at the maximum range that are marked as valid, amid "
                            "shorter ones: nothing came back from what they met, and they count as if they were not "
                            "there");
    }
    if (isTilted(scans)) {
      add(Weight::problem, who + "scans a plane tilted by " + fixed(degrees(scans.tilt()), 0) +
                               " deg against the floor, so it is not used for 2D maps; if its sensor pose is wrong, "
                               "correct it in [mapper] sensors");
    }
    if (scans.isUpsideDown()) add(Weight::note, who + "is mounted upside down according to its sensor pose");
    const auto lasers = usableLasers(facts_);
    if (!lasers.empty() && lasers.front() == label) judgeSweep(who, scans);  // laser odometry uses one laser
    if (scans.sensor_pose_moves) add(Weight::note, who + "moves on the base according to its sensor poses");
  }

  void judgeOdometry() {
    if (facts_.odometry.empty()) {
      if (!usableLasers(facts_).empty())
        add(Weight::warning, "there is no odometry: the motion is estimated from the scans alone");
      return;
    }
    for (const auto& [label, odometry] : facts_.odometry) {
      const std::string who = quoted(label) + ": ";
      if (odometry.not_finite > 0)
        add(Weight::warning, who + counted(odometry.not_finite, "reading") + " whose pose is not finite");
      if (odometry.jumps > 0) {
        add(Weight::problem, who + "jumps " + counted(odometry.jumps, "time") + ", by up to " +
                                 fixed(odometry.largest_jump, 2) + " m, the largest " +
                                 sinceStart(odometry.largest_at) +
                                 "; cut the log there ([source] start_s, end_s) or map without this odometry");
      }
      const auto motions = motionsWith(facts_, label);
      if (motions.empty()) continue;
      judgeCover(label, *motions.front());
      judgeMotion(who, *motions.front(), isReversed(facts_, label));
    }
  }

  void judgeCover(const std::string& odometry, const MotionFacts& motion) {
    if (clockStands(facts_)) return;
    const double covered = facts_.covered.at({motion.laser, odometry});
    const bool is_by_clock = motion.clock && motion.clock->isWrong();  // which is said and corrected
    if (covered >= 0.95 || is_by_clock) return;
    const std::string who = quoted(odometry) + " and " + quoted(motion.laser) + ": ";
    const std::string rest = percent(1 - covered) + " of the scans lie outside of the time span of the odometry";
    if (covered >= 0.5) return add(Weight::warning, who + rest);
    const auto first = [&](const std::string& label) {
      base::Stamp stamp;
      for (const auto& [sensor, stamps] : facts_.sensors) {
        if (sensor.first == label) stamp = stamps.first;
      }
      return stamp;
    };
    add(Weight::problem, who + rest + "; the odometry starts " +
                             fixed(base::secondsBetween(first(motion.laser), first(odometry)), 1) +
                             " s after the scans: do their clocks differ, or are they of two logs?");
  }

  void judgeMotion(const std::string& who, const MotionFacts& motion, bool reversed) {
    if (motion.frozen > 0) {
      const bool frozen = isFrozen(motion);
      add(frozen || 5 * motion.frozen > motion.moved ? Weight::problem : Weight::warning,
          who + "measures no motion in " + std::to_string(motion.frozen) + " of " + std::to_string(motion.moved) +
              " pairs of scans that show motion" + (frozen ? ": it is frozen" : "") + ", first " +
              sinceStart(motion.first_frozen));
    }
    if (reversed)
      add(Weight::problem, who + "is reversed compared with the scans" + reversedText(motion) +
                               "; correct its signs, or map without it");
    const bool is_known = wrongTurnOf(facts_, motion.laser, motion.odometry) == Culprit::none;
    if (reversed || isFrozen(motion) || !is_known) return;  // the rest follows from that
    if (motion.turn_scale && std::abs(*motion.turn_scale - 1) > 0.1) {
      add(Weight::warning,
          who + "measures a turn of " + fixed(*motion.turn_scale, 2) + " rad where the scans measure 1 rad");
    }
    if (motion.mounting && std::abs(motion.mounting->scale - 1) > 0.05) {
      add(Weight::warning, who + "measures " + fixed(motion.mounting->scale, 2) + " m where the scans measure 1 m");
    }
    const motion::WheelOdometryOptions defaults;
    const auto noise = [&](const std::optional<double>& measured, double value, const std::string& what, int decimals,
                           double unit) {
      if (!measured || *measured < 2 * value) return;
      add(Weight::warning, who + "its noise, " + fixed(*measured / unit, decimals) + what + ", is " +
                               fixed(*measured / value, 1) + " times the default of [odometry]");
    };
    noise(motion.position_noise_per_root_m, defaults.position_noise_per_root_m, " m after 1 m travelled", 2, 1);
    noise(motion.yaw_noise_per_root_turn, defaults.yaw_noise_per_root_turn, " rad after a turn of 1 rad", 2, 1);
    noise(motion.yaw_noise_per_root_m, defaults.yaw_noise_per_root_m, " deg after 1 m travelled", 1,
          base::option_text::kRadiansPerDegree);
  }

  static std::string reversedText(const MotionFacts& motion) {
    switch (contradictionOf(motion)) {
      case Contradiction::forward:
        return " (forward is backward)";
      case Contradiction::turning:
        return " (left is right)";
      default:
        return " (forward is backward, left is right)";
    }
  }

  void judgePairs() {
    for (const auto& pair : facts_.odometry_pairs) {
      constexpr double kShare = 0.05;
      if (pair.contrary < 3 || static_cast<double>(pair.contrary) < kShare * static_cast<double>(pair.spans)) continue;
      add(Weight::warning, quoted(pair.a) + " and " + quoted(pair.b) +
                               ": the two odometries contradict each other in " + std::to_string(pair.contrary) +
                               " of " + counted(pair.spans, "time span") + " with motion, first " +
                               sinceStart(pair.first_contrary) +
                               "; choose one with [odometry] label and [scan_odometry] odometry_label");
    }
  }

  // Whether turns of the log are measured wrong by so much that headings suffer.
  bool isSweepHarmful(const SweepFacts& sweep) const {
    constexpr double kMuch = 0.01;  // [s], which at 1 rad/s is an error of some 0.2 % of a turn
    return std::abs(std::max(0.0, sweep.sweep) - sweep.declared) > kMuch;
  }

  void judgeSweep(const std::string& who, const ScanFacts& scans) {
    if (!scans.sweep || !scans.sweep->isWrong()) return;
    const auto& sweep = *scans.sweep;
    const std::string measured = fixed(sweep.sweep, 4) + " +- " + fixed(std::max(0.0001, sweep.sigma), 4) + " s";
    const std::string declared = sweep.declared > 0 ? "the INI declares " + fixed(sweep.declared, 4) + " s"
                                                    : std::string("the INI declares that all beams are simultaneous");
    const bool is_instant = sweep.isInstant();
    contradict(
        isSweepHarmful(sweep) ? Weight::problem : Weight::warning,
        who +
            (is_instant
                 ? "its scans turn and match as if all beams were measured at once"
                 : "its scans turn and match as if their beams were measured one after the other in " + measured) +
            ", but " + declared + "; set [scan_odometry] sweep_s = " + (is_instant ? "0" : fixed(sweep.sweep, 4)));
  }

  // Whether the direction of up was measured in the frame of these poses.
  bool isMeasured(const std::string& poses) const {
    return std::any_of(facts_.levels.begin(), facts_.levels.end(), [&](const LevelFacts& level) {
      return level.of_poses && level.is_known && level.poses == poses;
    });
  }

  bool isFloorKnown() const {
    return std::any_of(facts_.cameras.begin(), facts_.cameras.end(),
                       [](const CameraFacts& camera) { return camera.height.has_value(); });
  }

  void judgeLevels() {
    constexpr double kTilt = 3 * base::option_text::kRadiansPerDegree, kSigmas = 3;
    constexpr double kMuch = 10 * base::option_text::kRadiansPerDegree;      // walls are no longer upright
    constexpr double kMostTilt = 45 * base::option_text::kRadiansPerDegree;  // of a robot on wheels
    for (const auto& level : facts_.levels) {
      const double tilt = level.tilt();
      if (!level.is_known || tilt < std::max(kTilt, kSigmas * level.sigma)) continue;
      if (!level.of_poses && !level.by_planes && tilt > kMostTilt) {
        contradict(Weight::problem, "according to " + level.by + ", up is " + fixed(degrees(tilt), 0) +
                                        " deg from the z axis of a robot on wheels: the sensor is mounted otherwise "
                                        "than its pose states, for example upside down; set its pose in [mapper] "
                                        "sensors, or leave it out");
        continue;
      }
      if (!level.of_poses && (tilt > kMostTilt || (level.by_planes && isFloorKnown()))) continue;
      // The rotation that takes the measured up to z: first roll, then pitch.
      const double roll = std::atan2(level.up.y(), level.up.z());
      const double pitch = -std::atan2(level.up.x(), std::hypot(level.up.y(), level.up.z()));
      const std::string by = "according to " + level.by + ", up is " + fixed(degrees(tilt), 1) + " +- " +
                             fixed(degrees(level.sigma), 1) + " deg from ";
      const std::string turn = "roll " + fixed(degrees(roll), 1) + " and pitch " + fixed(degrees(pitch), 1) + " deg";
      if (level.of_poses) {
        add(tilt > kMuch ? Weight::problem : Weight::warning,
            quoted(level.poses) + ": the poses are not level: " + by + "the z axis of their frame; rotate them by " +
                turn + ", or map in space ([mapper] motion = spatial), where surfaces are judged by the measured up");
      } else {
        add(Weight::warning, "the base is not level: " + by +
                                 "its z axis; if the pose of the sensor on the base is wrong, set it in [mapper] "
                                 "sensors, rotated by " +
                                 turn);
      }
    }
  }

  void judgePoses() {
    // Frames whose y or x axis points up are tilted by 90 deg; a camera in the hand often looks down by half of that.
    constexpr double kTilted = 45 * base::option_text::kRadiansPerDegree;
    constexpr double kOnItsSide = 70 * base::option_text::kRadiansPerDegree;
    for (const auto& [label, poses] : facts_.poses) {
      if (poses.tilt < kTilted || isMeasured(label)) continue;
      if (poses.tilt < kOnItsSide) {
        add(Weight::note, quoted(label) + ": on average the base is tilted by " + fixed(degrees(poses.tilt), 0) +
                              " deg, which is right for a camera in the hand; if a robot drove on a floor, the poses "
                              "are not level");
        continue;
      }
      add(Weight::problem,
          quoted(label) + ": the poses are not level: on average the base is tilted by " +
              fixed(degrees(poses.tilt), 0) +
              " deg against the z axis of their frame, by which floors and walls are distinguished; rotate "
              "the poses so that z points up, or set the pose of the sensor on the base in [mapper] sensors");
    }
  }

  void judgeSensorPose(const std::string& laser) {
    const auto& scans = facts_.scans.at(laser);
    if (const auto aperture = betterAperture(facts_, laser)) {
      contradict(Weight::problem,
                 quoted(laser) + ": its scans declare an aperture of " + fixed(degrees(scans.aperture), 0) +
                     " deg, but they match and turn with the odometry better with " + fixed(degrees(*aperture), 0) +
                     " deg; set aperture_deg of this laser in [mapper] sensors");
    }
    judgeTurns(laser);
    judgeAhead(laser);
    const auto better = betterSensorPose(facts_, laser);
    const std::string who = quoted(laser) + ": ";
    const std::string missing = "its sensor pose is missing: in the log it is at the origin of the base";
    if (!better) {
      if (scans.isAtOrigin()) add(Weight::warning, who + missing + "; if it is elsewhere, set it in [mapper] sensors");
      return;
    }
    constexpr double kMuch = 22;  // [deg] at which maps of a laser and wheels suffer
    const auto change = *better - scans.base_from_sensor;
    const bool upside_down = change.getRotationMatrix()(2, 2) < 0;
    const bool backwards = !upside_down && std::abs(degrees(change.yaw())) > 150;
    const bool little = !upside_down && !backwards && std::abs(degrees(change.yaw())) < kMuch;
    const std::string verdict = upside_down          ? "is mounted upside down, which its sensor pose does not state"
                                : backwards          ? "looks backwards, which its sensor pose does not state"
                                : scans.isAtOrigin() ? missing
                                                     : "is mounted otherwise than its sensor pose states";
    contradict(little ? Weight::warning : Weight::problem,
               who + verdict + "; according to its motion, set " + poseKeys(*better) + " for it in [mapper] sensors");
  }

  void judgeAhead(const std::string& laser) {
    const auto& ahead = facts_.scans.at(laser).constant_ahead;
    if (!ahead) return;
    const auto pose = poseByFloor(facts_.scans.at(laser));
    contradict(Weight::problem,
               quoted(laser) + ": while the robot drives on, what the laser sees ahead stays " +
                   fixed(ahead->value, 1) +
                   " m away: its beams meet the floor, because it is tilted, or a part of the robot; " +
                   (pose ? "if it is the floor, set " + poseKeys(*pose) + " for it in [mapper] sensors"
                         : "set its pose in [mapper] sensors, with its height, or limit the range ([laser_points] "
                           "max_range_m)"));
  }

  void judgeTurns(const std::string& laser) {
    for (const auto& [odometry, facts] : facts_.odometry) {
      if (wrongTurnOf(facts_, laser, odometry) != Culprit::not_known) continue;
      contradict(
          Weight::problem,
          quoted(laser) + " and " + quoted(odometry) +
              ": where the scans turn left, the odometry turns right, and nothing else in the log tells which of the "
              "two is wrong. Either the laser is mounted upside down or its beams run the other way round: then set " +
              poseKeys(facts_.scans.at(laser).base_from_sensor + mrpt::poses::CPose3D(0, 0, 0, 0, 0, M_PI)) +
              " for it in [mapper] sensors, otherwise the map is a mirror image. Or the wheels take left for right: "
              "then the map is right as it is. Compare the map with the place: is what was on the left of the robot on "
              "its left?");
    }
  }

  const LogFacts& facts_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> judge(const LogFacts& facts) {
  return Judge(facts).findings();
}

}  // namespace omnimapper::check
