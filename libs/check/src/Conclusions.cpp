// Conclusions from the facts for the mapper: which laser and odometry to use, and where a laser really is.
#include "Conclusions.h"

#include <mrpt/math/wrap2pi.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/matching/ScanInBase.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Format.h"

namespace omnimapper::check {

namespace {

constexpr double kFewestValid = 0.02;  // share of the beams
constexpr std::size_t kFewestPairs = 8;
constexpr double kMost = 0.7;  // share of the pairs that must show a contradiction

bool isMost(std::size_t part, std::size_t all) {
  return all >= kFewestPairs && static_cast<double>(part) > kMost * static_cast<double>(all);
}

}  // namespace

const MotionFacts* motionOf(const LogFacts& facts, const std::string& laser, const std::string& odometry) {
  for (const auto& motion : facts.motions) {
    if (motion.laser == laser && motion.odometry == odometry) return &motion;
  }
  return nullptr;
}

bool isTilted(const ScanFacts& scans) {
  return scans.tilt() > matching::kLargestTilt;
}

std::optional<mrpt::poses::CPose3D> poseByFloor(const ScanFacts& scans) {
  using mrpt::poses::CPose3D;
  constexpr double kLeastHeight = 0.1;  // [m]
  const auto& declared = scans.base_from_sensor;
  const double height = declared.z();
  if (!scans.constant_ahead) return std::nullopt;
  const double ahead = scans.constant_ahead->value;
  if (height < kLeastHeight || height > 0.5 * ahead) return std::nullopt;
  // How far the scanned plane goes down ahead according to the declared pose [rad].
  const auto rotation = declared.getRotationMatrix();
  const double side = rotation(2, 2) < 0 ? -1 : 1;
  const double down = std::atan2(side * rotation(0, 2), side * rotation(2, 2));
  const double wanted = std::asin(height / ahead);
  if (wanted > matching::kLargestTilt) return std::nullopt;
  const CPose3D place(declared.x(), declared.y(), declared.z(), 0, 0, 0);
  return place + CPose3D(0, 0, 0, 0, wanted - down, 0) +
         CPose3D(0, 0, 0, declared.yaw(), declared.pitch(), declared.roll());
}

bool saturates(const ScanFacts& scans) {
  constexpr double kLeast = 0.001;  // of the valid beams
  return scans.longest_share > kLeast && scans.longest_stands_out;
}

bool isFrozen(const MotionFacts& motion) {
  return isMost(motion.frozen, motion.moved);
}

Contradiction contradictionOf(const MotionFacts& motion) {
  const bool forward = isMost(motion.forward_reversed, motion.forward);
  const bool turning = isMost(motion.turning_reversed, motion.turning);
  if (forward && turning) return Contradiction::both;
  if (forward) return Contradiction::forward;
  return turning ? Contradiction::turning : Contradiction::none;
}

std::vector<const MotionFacts*> motionsWith(const LogFacts& facts, const std::string& odometry) {
  std::vector<const MotionFacts*> motions;
  for (const auto& laser : usableLasers(facts)) {
    if (const auto* motion = motionOf(facts, laser, odometry)) motions.push_back(motion);
  }
  return motions;
}

// Gyroscopes, cameras, other lasers and other odometries are asked which of the two they agree with.
Culprit wrongTurnOf(const LogFacts& facts, const std::string& laser, const std::string& odometry) {
  const auto* motion = motionOf(facts, laser, odometry);
  if (!motion || contradictionOf(*motion) != Contradiction::turning) return Culprit::none;
  int against_laser = 0, against_odometry = 0;
  const auto count = [&](bool agrees_with_laser) { ++(agrees_with_laser ? against_odometry : against_laser); };
  for (const auto& gyroscope : facts.gyroscopes) {
    if (gyroscope.laser == laser && gyroscope.clock) count(!gyroscope.clock->is_reversed);
  }
  for (const auto& camera : facts.cameras) {
    constexpr std::size_t kEnough = 10;  // walls on which both agree
    if (camera.laser == laser && camera.matched >= kEnough) count(camera.are != CameraFacts::Images::mirrored);
  }
  for (const auto& other : facts.motions) {
    if (&other == motion || other.turning < kFewestPairs) continue;
    const bool is_against = contradictionOf(other) == Contradiction::turning;
    if (other.laser == laser && other.odometry != odometry) count(!is_against);
    if (other.odometry == odometry && other.laser != laser) count(is_against);
  }
  if (against_laser == against_odometry) return Culprit::not_known;
  return against_laser > against_odometry ? Culprit::laser : Culprit::odometry;
}

// A wrong sensor pose hardly explains both directions at once, or several lasers that are wrong in the same way.
bool isReversed(const LogFacts& facts, const std::string& odometry) {
  const auto motions = motionsWith(facts, odometry);
  if (motions.empty()) return false;
  const auto first = contradictionOf(*motions.front());
  if (first == Contradiction::turning) return wrongTurnOf(facts, motions.front()->laser, odometry) == Culprit::odometry;
  const bool all_same = std::all_of(motions.begin(), motions.end(),
                                    [&](const MotionFacts* motion) { return contradictionOf(*motion) == first; });
  return first == Contradiction::both || (first != Contradiction::none && motions.size() > 1 && all_same);
}

std::vector<std::string> usableLasers(const LogFacts& facts) {
  std::vector<std::string> labels;
  for (const auto& [label, scans] : facts.scans) {
    const bool sees = scans.valid_share > kFewestValid && 10 * (scans.blind + scans.empty) < 9 * scans.scans;
    if (sees && !isTilted(scans)) labels.push_back(label);
  }
  const auto view = [&](const std::string& label) {
    const auto& scans = facts.scans.at(label);
    return scans.valid_share * scans.aperture;
  };
  std::stable_sort(labels.begin(), labels.end(),
                   [&](const std::string& a, const std::string& b) { return view(a) > view(b); });
  return labels;
}

namespace {

constexpr double kNotMeasured = 1e3;  // [m]

struct Candidate {
  std::string label;
  double noise;  // [m] after 1 m travelled
};

// Odometries that measure the motion, first the one that agrees best with the scans.
std::vector<Candidate> usableOdometries(const LogFacts& facts) {
  const auto lasers = usableLasers(facts);
  std::vector<Candidate> candidates;
  for (const auto& [label, odometry] : facts.odometry) {
    if (odometry.readings < 2 + odometry.not_finite) continue;
    const auto* motion = lasers.empty() ? nullptr : motionOf(facts, lasers.front(), label);
    if (motion && (facts.covered.at({motion->laser, label}) < 0.5 || isFrozen(*motion))) continue;
    if (isReversed(facts, label)) continue;
    candidates.push_back(
        {label, motion && motion->position_noise_per_root_m ? *motion->position_noise_per_root_m : kNotMeasured});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.noise < b.noise; });
  return candidates;
}

}  // namespace

std::optional<std::string> usableOdometry(const LogFacts& facts) {
  const auto candidates = usableOdometries(facts);
  return candidates.empty() ? std::nullopt : std::optional(candidates.front().label);
}

bool isOneOdometryBest(const LogFacts& facts) {
  constexpr double kMuchWorse = 1.5, kFewMillimetres = 0.005;  // [1] [m]
  const auto candidates = usableOdometries(facts);
  const bool are_measured =
      std::all_of(candidates.begin(), candidates.end(), [](const Candidate& one) { return one.noise < kNotMeasured; });
  return facts.odometry.size() > 1 && !candidates.empty() && are_measured &&
         (candidates.size() == 1 || candidates[1].noise > kMuchWorse * candidates[0].noise + kFewMillimetres);
}

std::optional<double> betterAperture(const LogFacts& facts, const std::string& laser) {
  const auto odometry = usableOdometry(facts);
  const auto* motion = odometry ? motionOf(facts, laser, *odometry) : nullptr;
  return motion ? motion->aperture : std::nullopt;
}

std::optional<mrpt::poses::CPose3D> betterSensorPose(const LogFacts& facts, const std::string& laser) {
  using mrpt::poses::CPose3D;
  constexpr double kSureYaw = 3 * base::option_text::kRadiansPerDegree;
  constexpr double kWrongYaw = 10 * base::option_text::kRadiansPerDegree;
  constexpr double kSurePosition = 0.05, kWrongPosition = 0.2;  // [m]
  constexpr double kTrust = 5;                                  // standard deviations
  const auto odometry = usableOdometry(facts);
  if (!odometry) return std::nullopt;
  const auto* motion = motionOf(facts, laser, *odometry);
  const auto& scans = facts.scans.at(laser);
  // Beams on the floor or on the robot itself pull every match towards rest.
  if (!motion || scans.sensor_pose_moves || scans.constant_ahead) return std::nullopt;
  const CPose3D& reported = scans.base_from_sensor;
  if (contradictionOf(*motion) == Contradiction::turning) {
    if (wrongTurnOf(facts, laser, *odometry) != Culprit::laser) return std::nullopt;
    return reported + CPose3D(0, 0, 0, 0, 0, std::acos(-1.0));
  }
  if (!motion->mounting) return std::nullopt;
  const auto& found = *motion->mounting;
  const double offset = std::hypot(found.x, found.y);
  const bool camera_agrees = std::any_of(facts.cameras.begin(), facts.cameras.end(), [&](const CameraFacts& camera) {
    return camera.laser == laser && isTurned(camera) && blamesLaser(facts, camera);
  });
  const double wrong = camera_agrees ? 0 : kWrongYaw;
  const bool wrong_yaw = found.yaw_sigma < kSureYaw && std::abs(found.yaw) > std::max(wrong, kTrust * found.yaw_sigma);
  const bool sure_position = found.position_sigma < kSurePosition;
  const bool wrong_position = sure_position && offset > std::max(kWrongPosition, kTrust * found.position_sigma);
  if (!wrong_yaw && !wrong_position) return std::nullopt;
  // A small angle may be an error of the odometry as well as of the sensor pose.
  return CPose3D(sure_position ? found.x : 0, sure_position ? found.y : 0, 0, wrong_yaw ? found.yaw : 0, 0, 0) +
         reported;
}

bool isBeyond(const ClockFacts& clock, double corrected) {
  constexpr double kSigmas = 2;  // short drives show an offset badly
  return corrected == 0 || std::abs(clock.offset) - kSigmas * clock.sigma > corrected;
}

double clockInIni(const LogFacts& facts, const std::string& label) {
  const auto found = facts.ini.clock_offsets.find(label);
  return found == facts.ini.clock_offsets.end() ? 0 : found->second;
}

std::map<std::string, double> clockOffsets(const LogFacts& facts) {
  // On six real logs with offsets of 0.04 to 0.13 s the maps were as good without a correction of the stamps.
  return clockOffsets(facts, kCorrectedOffset);
}

std::map<std::string, double> clockOffsets(const LogFacts& facts, double least) {
  std::map<std::string, double> offsets;
  const auto lasers = usableLasers(facts);
  if (lasers.empty()) return offsets;
  const auto& laser = lasers.front();
  std::size_t measured = 0;
  std::vector<double> wrong;  // offsets of the sensors that differ from the laser
  const auto add = [&](const std::string& label, const std::optional<ClockFacts>& clock, double corrected) {
    if (!clock) return;
    ++measured;
    if (!clock->isWrong() || !isBeyond(*clock, corrected)) return;
    offsets[label] = -clock->offset;
    wrong.push_back(clock->offset);
  };
  for (const auto& motion : facts.motions) {
    if (motion.laser == laser) add(motion.odometry, motion.clock, least);
  }
  for (const auto& gyroscope : facts.gyroscopes) {
    if (gyroscope.laser == laser) add(gyroscope.gyroscope, gyroscope.clock, least);
  }
  for (const auto& camera : facts.cameras) {
    if (camera.laser == laser && camera.clock && std::abs(camera.clock->value) > kRollingShutter)
      add(camera.camera, ClockFacts{camera.clock->value, camera.clock->sigma, 0, false}, 0);
  }
  // If several others agree with each other and none with the laser, it is the laser's clock that differs.
  constexpr double kSame = 0.05;  // [s]
  const auto ends = std::minmax_element(wrong.begin(), wrong.end());
  if (wrong.size() > 1 && wrong.size() == measured && *ends.second - *ends.first < kSame) {
    const double middle = 0.5 * (*ends.first + *ends.second);
    offsets.clear();
    for (const auto& label : lasers) offsets[label] = middle;
  }
  return offsets;
}

bool hasWrongScale(const CameraFacts& camera) {
  return camera.scale && camera.scale->differs(1, kWrongScale);
}

bool hasWrongFocalLength(const CameraFacts& camera) {
  constexpr double kWrongFocal = 0.06;
  return camera.focal && camera.focal->differs(1, kWrongFocal);
}

bool isTilted(const CameraFacts& camera) {
  constexpr double kLeast = 3 * base::option_text::kRadiansPerDegree;
  return camera.height && camera.tilt > kLeast;
}

bool isTurned(const CameraFacts& camera) {
  constexpr double kLeast = 1.5 * base::option_text::kRadiansPerDegree;
  return camera.yaw && camera.yaw->differs(0, kLeast);
}

bool blamesLaser(const LogFacts& facts, const CameraFacts& camera) {
  constexpr double kLeast = 1 * base::option_text::kRadiansPerDegree, kSame = 1.5 * kLeast, kSigmas = 4;
  for (const auto& motion : facts.motions) {
    if (motion.laser != camera.laser) continue;
    const auto turn = wrongTurnOf(facts, motion.laser, motion.odometry);
    if (turn == Culprit::laser || turn == Culprit::not_known) return true;
    if (!camera.yaw || !motion.mounting) continue;
    // The camera is turned against the laser by as much as the laser is turned against the base.
    const auto& laser = *motion.mounting;
    const double off = mrpt::math::wrapToPi(camera.yaw->value + laser.yaw);
    const double sigma = std::hypot(camera.yaw->sigma, laser.yaw_sigma);
    if (std::abs(laser.yaw) > std::max(kLeast, kSigmas * laser.yaw_sigma) &&
        std::abs(off) < std::max(kSame, kSigmas * sigma))
      return true;
  }
  return false;
}

std::optional<double> neededNoise(const IniFacts& ini, const CameraFacts& camera) {
  const double usual = perception::PlaneOptions().noise_at_1m, needed = camera.noise * usual;
  constexpr double kSame = 1.01;
  // With depths in another unit nothing is known of their noise.
  if (hasWrongScale(camera) || kSame * std::max(ini.depth_noise, usual) >= needed) return std::nullopt;
  return needed;
}

std::optional<Measured> trueHeight(const CameraFacts& camera) {
  if (!camera.height || !camera.scale) return std::nullopt;
  const auto &height = *camera.height, &scale = *camera.scale;
  return Measured{height.value * scale.value, std::hypot(height.sigma * scale.value, height.value * scale.sigma)};
}

bool hasWrongHeight(const CameraFacts& camera) {
  constexpr double kLeast = 0.05;           // [m]
  constexpr std::size_t kFewestWalls = 10;  // on which camera and laser agree
  const auto height = trueHeight(camera);
  // A camera without a height was never placed.
  return height && camera.matched >= kFewestWalls && camera.declared.z() >= kLeast &&
         height->differs(camera.declared.z(), kLeast);
}

std::optional<mrpt::poses::CPose3D> betterCameraPose(const CameraFacts& camera) {
  if (!camera.pose || !(isTilted(camera) || isTurned(camera) || hasWrongHeight(camera))) return std::nullopt;
  auto pose = *camera.pose;
  if (hasWrongHeight(camera)) pose.z(trueHeight(camera)->value);
  return pose;
}

std::optional<double> scaleByHeight(const CameraFacts& camera) {
  constexpr double kLeast = 0.05, kRatio = 1.33;  // [m] [-]
  if (!camera.height || camera.declared.z() < kLeast) return std::nullopt;
  const double scale = camera.declared.z() / camera.height->value;
  if (scale < kRatio && scale > 1 / kRatio) return std::nullopt;
  return scale;
}

bool clockStands(const LogFacts& facts) {
  constexpr std::size_t kSome = 10;  // observations that a sensor must have to be judged
  bool stands = false;
  for (const auto& [sensor, stamps] : facts.sensors) {
    if (stamps.count < kSome) continue;
    if (2 * (stamps.repeated + stamps.no_stamp) <= stamps.count) return false;
    stands = true;
  }
  return stands;
}

}  // namespace omnimapper::check
