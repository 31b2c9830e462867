#pragma once

#include <omnimapper/check/LogFacts.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::check {

/// How odometry and scans contradict each other: forward is backward, left is right, or both.
enum class Contradiction { none, forward, turning, both };

Contradiction contradictionOf(const MotionFacts& motion);
/// The comparison of that laser with that odometry; null if there is none.
const MotionFacts* motionOf(const LogFacts& facts, const std::string& laser, const std::string& odometry);
/// Whether the odometry is at rest in most pairs of scans that show motion.
bool isFrozen(const MotionFacts& motion);
/// [s] that the INI already adds to the stamps of a sensor.
double clockInIni(const LogFacts& facts, const std::string& label);
/// [s] Laser odometry finds smaller offsets between the clocks of the motion and of the laser by itself.
constexpr double kCorrectedOffset = 0.3;
/// Whether the offset of a clock is surely larger than what is corrected anyway [s].
bool isBeyond(const ClockFacts& clock, double corrected);
/// As clockOffsets() of judge.h, for offsets of odometries and gyroscopes of at least that many seconds.
std::map<std::string, double> clockOffsets(const LogFacts& facts, double least);
/// Which of the two is wrong where scans and odometry turn against each other: none if they do not, not_known if
/// nothing else in the log measures the turns.
enum class Culprit { none, laser, odometry, not_known };
Culprit wrongTurnOf(const LogFacts& facts, const std::string& laser, const std::string& odometry);
/// Whether the odometry is reversed, rather than a laser mounted otherwise than its pose states.
bool isReversed(const LogFacts& facts, const std::string& odometry);
/// Whether the log has several odometries, and usableOdometry() agrees with the scans much better than the others or is
/// the only one that measures the motion.
bool isOneOdometryBest(const LogFacts& facts);
/// Whether the scanned plane is not parallel to the floor.
bool isTilted(const ScanFacts& scans);
/// base_from_sensor with the tilt at which the beams ahead meet the floor where they do. None if they meet none, if the
/// height of the laser is not declared, or if a laser that is tilted so much is of no use.
std::optional<mrpt::poses::CPose3D> poseByFloor(const ScanFacts& scans);
/// Whether beams that met nothing are marked as valid, all at one range.
bool saturates(const ScanFacts& scans);
/// Whether most stamps of every sensor are missing or repeat the one before, so that the clock stands still and not one
/// sensor.
bool clockStands(const LogFacts& facts);
/// [s] Rows of an image are exposed one after the other, which alone makes its clock differ by up to this.
constexpr double kRollingShutter = 0.03;
constexpr double kWrongScale = 0.04;  ///< [-] of a camera's depths, that is no error of the measurement
/// What floor and walls show to be wrong with a camera, beyond the errors of the measurement.
bool hasWrongScale(const CameraFacts& camera);
bool hasWrongFocalLength(const CameraFacts& camera);
bool isTilted(const CameraFacts& camera);
bool isTurned(const CameraFacts& camera);
/// Whether the floor is at another distance than the declared height, by depths whose scale the walls of the laser
/// show.
bool hasWrongHeight(const CameraFacts& camera);
/// base_from_sensor of a camera that is tilted, turned or at another height than declared; none of any other.
std::optional<mrpt::poses::CPose3D> betterCameraPose(const CameraFacts& camera);
/// Whether it differs from the laser because the laser is wrong: the motion of the robot shows this, too.
bool blamesLaser(const LogFacts& facts, const CameraFacts& camera);
/// [m] `[planes] noise_at_1m_m` with which planes are found, if hardly any are found with that of the INI; none
/// if that of the INI does, or if the depths have another unit.
std::optional<double> neededNoise(const IniFacts& ini, const CameraFacts& camera);
/// [m] Height of the camera over the floor that it sees, by the scale of its depths that the walls of the laser show;
/// none if the log shows only one of the two.
std::optional<Measured> trueHeight(const CameraFacts& camera);
/// True depth divided by depth in the log, if the declared height of the camera is right and the floor appears at
/// another distance by a third or more; none else, or if no height is declared.
std::optional<double> scaleByHeight(const CameraFacts& camera);
/// Comparisons of that odometry with all usable lasers, the best laser first.
std::vector<const MotionFacts*> motionsWith(const LogFacts& facts, const std::string& odometry);

}  // namespace omnimapper::check
