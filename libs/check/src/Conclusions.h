#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// How odometry and scans contradict each other: forward is backward, left is right, or both.
enum class Contradiction { none, forward, turning, both };

Contradiction contradictionOf(const MotionFacts& motion);
/// Odometry at rest while the scans move, most of the time.
bool isFrozen(const MotionFacts& motion);
/// Whether the odometry runs backwards, rather than a laser being mounted otherwise than said.
bool isReversed(const LogFacts& facts, const std::string& odometry);
/// Whether the log has several odometries, of which usableOdometry() is nearer to the scans than the others by far, or
/// the only one that tells the motion.
bool isOneOdometryBest(const LogFacts& facts);
/// Whether the scans are not of a plane like the floor's.
bool isTilted(const ScanFacts& scans);
/// Whether beams that met nothing are marked as valid, at one range.
bool saturates(const ScanFacts& scans);
/// Whether most stamps of every sensor that has some repeat the one before: the clock stood, not one sensor.
bool clockStands(const LogFacts& facts);
/// Of all usable lasers with that odometry, the best first.
std::vector<const MotionFacts*> motionsWith(const LogFacts& facts, const std::string& odometry);

}  // namespace omnimapper::check
