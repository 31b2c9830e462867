#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// How odometry and scans contradict each other: forward is backward, left is right, or both.
enum class Contradiction { none, forward, turning, both };

Contradiction contradictionOf(const MotionFacts& motion);
/// Whether the odometry is at rest in most pairs of scans that show motion.
bool isFrozen(const MotionFacts& motion);
/// Whether the odometry is reversed, rather than a laser mounted otherwise than its pose states.
bool isReversed(const LogFacts& facts, const std::string& odometry);
/// Whether the log has several odometries, and usableOdometry() agrees with the scans much better than the others or is
/// the only one that measures the motion.
bool isOneOdometryBest(const LogFacts& facts);
/// Whether the scanned plane is not parallel to the floor.
bool isTilted(const ScanFacts& scans);
/// Whether beams that met nothing are marked as valid, all at one range.
bool saturates(const ScanFacts& scans);
/// Whether most stamps of every sensor repeat the one before, so that the clock stands still and not one sensor.
bool clockStands(const LogFacts& facts);
/// Comparisons of that odometry with all usable lasers, the best laser first.
std::vector<const MotionFacts*> motionsWith(const LogFacts& facts, const std::string& odometry);

}  // namespace omnimapper::check
