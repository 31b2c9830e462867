#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "laser2d/ScanOdometryPlugin.h"

namespace omnimapper::plugins::scan_odometry_plugin_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose2D;
using testing::SimulatedLog;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

SimulatedLog halfALap() {
  testing::SimulatedLogOptions options;
  options.laps = 0.5;
  return SimulatedLog(options);
}

using Change = std::function<CObservation::Ptr(CObservation::Ptr)>;

// The motion over the log, from its first scan to its last, by a plugin that gets all observations first.
struct Measured {
  CPose2D motion, truth;
  Eigen::Matrix3d covariance;
};
Measured follow(const SimulatedLog& log, const Change& change, const ScanOdometryOptions& options = {}) {
  ScanOdometryPlugin plugin(options, {}, {}, {});
  std::vector<base::Stamp> scans;
  for (auto observation : log.observations()) {
    observation = change(observation);
    if (!observation) continue;
    plugin.add(observation);
    if (dynamic_cast<const CObservation2DRangeScan*>(observation.get())) scans.push_back(observation->timestamp);
  }
  plugin.processUntil(scans.back());
  const auto measured = plugin.between(scans.front(), scans.back());
  if (!measured) return {};
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const int planar[] = {0, 1, 5};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) covariance(i, j) = measured->covariance(planar[i], planar[j]);
  return {CPose2D(measured->begin_from_end), log.truthAt(scans.back()) - log.truthAt(scans.front()), covariance};
}

void expectNear(const Measured& measured, const std::string& what) {
  const CPose2D error = measured.motion - measured.truth;
  EXPECT_GT(measured.truth.norm(), 5) << what;
  EXPECT_LT(error.norm(), 0.25) << what;
  EXPECT_LT(std::abs(error.phi()), 1.5 * kDegree) << what;
}

CObservation::Ptr withOdometry(CObservation::Ptr observation, const std::function<CPose2D(const CPose2D&)>& change) {
  auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
  if (odometry) odometry->odometry = change(odometry->odometry);
  return observation;
}

TEST(ScanOdometryPlugin, FollowsTheLaserWhateverTheWheelsSay) {
  const auto log = halfALap();
  expectNear(follow(log, [](auto observation) { return observation; }), "as it is");
  expectNear(follow(log,
                    [](auto observation) {
                      return std::dynamic_pointer_cast<CObservationOdometry>(observation) ? nullptr : observation;
                    }),
             "absent");
  expectNear(follow(log, [](auto o) { return withOdometry(o, [](const CPose2D&) { return CPose2D(); }); }), "frozen");
  expectNear(
      follow(log,
             [](auto o) { return withOdometry(o, [](const CPose2D& p) { return CPose2D(-p.x(), -p.y(), p.phi()); }); }),
      "reversed");
  const base::Stamp middle = log.begin() + (log.end() - log.begin()) / 2;
  expectNear(follow(log,
                    [&](auto o) {
                      return withOdometry(o, [&](const CPose2D& p) {
                        return o->timestamp < middle ? p : CPose2D(p.x() + 5, p.y(), p.phi());
                      });
                    }),
             "a jump of 5 m");
}

// A scan of the two walls of a corridor, which are 2.4 m apart and have no visible end. Some noise distinguishes it
// from one that the laser repeats.
CObservation::Ptr scanOfACorridor(double seconds) {
  constexpr int kBeams = 181;
  constexpr float kReach = 8;
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "laser";
  scan->timestamp = base::stampFromUnix(1e9 + seconds);
  scan->aperture = static_cast<float>(M_PI);
  scan->maxRange = kReach;
  scan->resizeScan(kBeams);
  for (int i = 0; i < kBeams; ++i) {
    const double across = std::abs(std::sin(-M_PI / 2 + i * M_PI / (kBeams - 1)));
    const double noise = 0.002 * std::sin(12.9 * i + 78 * seconds);
    const auto range = static_cast<float>(1.2 / std::max(across, 1e-3) + noise);
    scan->setScanRange(i, range);
    scan->setScanRangeValidity(i, range < kReach);
  }
  return scan;
}

// For 3 s the laser repeats one scan, while the wheels turn on.
TEST(ScanOdometryPlugin, AFrozenLaserIsLeftOutAndCounted) {
  const auto log = halfALap();
  ScanOdometryPlugin plugin({}, {}, {}, {});
  CObservation2DRangeScan::Ptr last;
  std::vector<CObservation::ConstPtr> scans;
  std::size_t repeated = 0;
  for (const auto& observation : log.observations()) {
    auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
    const double seconds = base::secondsBetween(log.begin(), observation->timestamp);
    if (scan && seconds > 5 && seconds < 8 && last) {
      const auto stamp = scan->timestamp;
      scan = std::make_shared<CObservation2DRangeScan>(*last);
      scan->timestamp = stamp;
      ++repeated;
    } else if (scan) {
      last = scan;
    }
    plugin.add(scan ? scan : observation);
    if (scan) scans.push_back(scan);
  }
  plugin.processUntil(scans.back()->timestamp);
  std::size_t left_out = 0;
  for (const auto& scan : scans) left_out += plugin.usablePart(scan) == nullptr;
  EXPECT_GE(left_out, repeated - 1) << "of " << repeated;
  EXPECT_LE(left_out, repeated);
  const auto measured = plugin.between(scans.front()->timestamp, scans.back()->timestamp);
  ASSERT_TRUE(measured);
  const CPose2D error = CPose2D(measured->begin_from_end) -
                        (log.truthAt(scans.back()->timestamp) - log.truthAt(scans.front()->timestamp));
  EXPECT_LT(error.norm(), 0.3);
  const auto evidence = plugin.evidence();
  const auto frozen = std::find_if(evidence.begin(), evidence.end(),
                                   [](const mapper::Evidence& one) { return one.name == "frozen_scans"; });
  ASSERT_NE(frozen, evidence.end());
  EXPECT_EQ(frozen->value, static_cast<double>(left_out));
  EXPECT_NE(frozen->reason.find("although the wheels moved"), std::string::npos) << frozen->reason;
}

// The base moves 1 cm from scan to scan, and the laser repeats itself for a minute.
TEST(ScanOdometryPlugin, AFrozenLaserIsLeftOutOfASlowDriveToo) {
  ScanOdometryPlugin plugin({}, {}, {}, {});
  std::size_t left_out = 0;
  const auto frozen = scanOfACorridor(0);
  for (int i = 0; i < 600; ++i) {
    auto odometry = CObservationOdometry::Create();
    odometry->sensorLabel = "odometry";
    odometry->timestamp = base::stampFromUnix(1e9 + 0.1 * i);
    odometry->odometry = CPose2D(0.01 * i, 0, 0);
    plugin.add(odometry);
    auto scan = std::make_shared<CObservation2DRangeScan>(dynamic_cast<const CObservation2DRangeScan&>(*frozen));
    scan->timestamp = odometry->timestamp;
    plugin.add(scan);
    plugin.processUntil(scan->timestamp);
    left_out += plugin.usablePart(scan) == nullptr;
  }
  EXPECT_GE(left_out, 596U);
}

// A log with each odometry twice, as CARMEN's logs have it: each scan repeats the last reading, however old it is.
TEST(ScanOdometryPlugin, TheOdometryThatAgreesWithTheMatchesBridgesAGap) {
  testing::SimulatedLogOptions options;
  options.laps = 0.8;
  const SimulatedLog log(options);
  // There are no scans for 3 s, in which the base turns.
  const auto heading = [&](double seconds) {
    return log.truthAt(log.begin() + base::durationFromSeconds(seconds)).phi();
  };
  double gap = 5;
  while (std::abs(mrpt::math::wrapToPi(heading(gap + 3) - heading(gap))) < 45 * kDegree) gap += 0.5;
  const auto in_gap = [&](base::Stamp stamp) {
    const double seconds = base::secondsBetween(log.begin(), stamp);
    return seconds > gap && seconds < gap + 3;
  };
  ScanOdometryPlugin plugin({}, {}, {}, {});
  std::vector<base::Stamp> scans;
  CPose2D last_reading;
  for (const auto& observation : log.observations()) {
    const bool is_scan = observation->sensorLabel == "laser";
    if (is_scan && in_gap(observation->timestamp)) continue;
    if (is_scan) {
      const auto stale = CObservationOdometry::Create();
      stale->sensorLabel = "laser_ODOM";
      stale->timestamp = observation->timestamp;
      stale->odometry = last_reading;
      plugin.add(stale);
      scans.push_back(observation->timestamp);
    } else {
      const auto& wheels = dynamic_cast<const CObservationOdometry&>(*observation);
      if (!in_gap(wheels.timestamp)) last_reading = wheels.odometry;
    }
    plugin.add(observation);
  }
  plugin.processUntil(scans.back());
  const auto measured = plugin.between(scans.front(), scans.back());
  ASSERT_TRUE(measured) << "the gap was not bridged";
  const CPose2D error = CPose2D(measured->begin_from_end) - (log.truthAt(scans.back()) - log.truthAt(scans.front()));
  EXPECT_LT(error.norm(), 0.3);
  EXPECT_LT(std::abs(error.phi()), 2 * kDegree);
  // The path across the gap is not straight, so that observations of other sensors in it get the right pose.
  const auto at = [&](double seconds) { return log.begin() + base::durationFromSeconds(seconds); };
  for (double seconds = gap + 0.5; seconds < gap + 3; seconds += 0.5) {
    const auto motion = plugin.between(at(gap), at(seconds));
    ASSERT_TRUE(motion);
    const CPose2D off = CPose2D(motion->begin_from_end) - (log.truthAt(at(seconds)) - log.truthAt(at(gap)));
    EXPECT_LT(off.norm(), 0.05) << seconds - gap;
    EXPECT_LT(std::abs(off.phi()), 2 * kDegree) << seconds - gap;
  }
}

SimulatedLog halfALapWith(std::vector<testing::SimulatedLaser> lasers) {
  testing::SimulatedLogOptions options;
  options.laps = 0.5;
  options.lasers = std::move(lasers);
  return SimulatedLog(options);
}

testing::SimulatedLaser laserAt(const std::string& label, double pitch, double roll) {
  testing::SimulatedLaser laser;
  laser.label = label;
  laser.base_from_sensor = mrpt::poses::CPose3D(0.2, 0.1, 0.3, 0.4, pitch, roll);
  return laser;
}

TEST(ScanOdometryPlugin, FollowsALaserThatIsUpsideDownOrALittleTilted) {
  const auto as_it_is = [](auto observation) { return observation; };
  expectNear(follow(halfALapWith({laserAt("laser", 0, 180 * kDegree)}), as_it_is), "upside down");
  expectNear(follow(halfALapWith({laserAt("laser", 5 * kDegree, 0)}), as_it_is), "tilted by 5 degrees");
}

TEST(ScanOdometryPlugin, OfATiltedLaserNothingIsTakenAndTheUserIsWarned) {
  const auto log = halfALapWith({laserAt("tilted", 30 * kDegree, 0)});
  ScanOdometryPlugin plugin({}, {}, {}, {});
  std::size_t scans = 0;
  for (const auto& observation : log.observations()) {
    EXPECT_EQ(plugin.add(observation), mapper::PosePlugin::Taken::not_mine);
    scans += observation->sensorLabel == "tilted";
  }
  plugin.processUntil(log.end());
  EXPECT_FALSE(plugin.coveredUntil()) << "else the queue would wait for it";
  ASSERT_EQ(plugin.warnings().size(), 1U) << "one for all scans";
  for (const auto& words : {std::to_string(scans) + " scans", std::string("'tilted'"), std::string("30 deg"),
                            std::string("[mapper] sensors")}) {
    EXPECT_NE(plugin.warnings().front().find(words), std::string::npos) << plugin.warnings().front();
  }
}

TEST(ScanOdometryPlugin, OfATiltedAndALevelLaserTheLevelOneIsTaken) {
  auto tilted = laserAt("tilted", 30 * kDegree, 0);
  tilted.phase = 0.001;  // comes first
  const auto log = halfALapWith({tilted, laserAt("level", 0, 0)});
  const auto coveredAndWarned = [&](const std::string& label) {
    ScanOdometryOptions options;
    options.label = label;
    ScanOdometryPlugin plugin(options, {}, {}, {});
    for (const auto& observation : log.observations()) plugin.add(observation);
    plugin.processUntil(log.end());
    return std::pair(plugin.coveredUntil().has_value(), plugin.warnings().size());
  };
  EXPECT_EQ(coveredAndWarned(""), std::pair(true, std::size_t{0}));
  EXPECT_EQ(coveredAndWarned("level"), std::pair(true, std::size_t{0}));
  EXPECT_EQ(coveredAndWarned("tilted"), std::pair(false, std::size_t{1}));
}

TEST(ScanOdometryPlugin, SpansAddUpAndScansInBetweenAreInterpolated) {
  const auto log = halfALap();
  ScanOdometryPlugin plugin({}, {}, {}, {});
  for (const auto& observation : log.observations()) plugin.add(observation);
  const auto at = [&](double seconds) { return log.begin() + base::durationFromSeconds(seconds); };
  EXPECT_FALSE(plugin.between(at(2), at(3))) << "nothing is processed early";
  plugin.processUntil(at(6));
  EXPECT_FALSE(plugin.between(at(5), at(7)));
  const auto whole = plugin.between(at(2.03), at(5.56)), first = plugin.between(at(2.03), at(4.4)),
             second = plugin.between(at(4.4), at(5.56));
  ASSERT_TRUE(whole && first && second);
  const auto sum = motion::compose(*first, *second);
  EXPECT_LT((sum.begin_from_end - whole->begin_from_end).norm(), 1e-9);
  EXPECT_LT((sum.covariance - whole->covariance).norm(), 1e-6 * whole->covariance.norm());
  const auto error = CPose2D(whole->begin_from_end) - (log.truthAt(at(5.56)) - log.truthAt(at(2.03)));
  EXPECT_LT(error.norm(), 0.05);
}

TEST(ScanOdometryPlugin, AScanAfterItsTimeIsLeftOutAndOrderBeforeItDoesNotMatter) {
  std::vector<CObservation::Ptr> scans;
  for (const auto& observation : halfALap().observations()) {
    if (std::dynamic_pointer_cast<CObservation2DRangeScan>(observation)) scans.push_back(observation);
  }
  scans.resize(80);
  const auto motionInOrder = [&](const std::vector<CObservation::Ptr>& order) {
    ScanOdometryPlugin plugin({}, {}, {}, {});
    for (const auto& scan : order) plugin.add(scan);
    plugin.processUntil(scans.back()->timestamp);
    for (int i = 0; i < 30; ++i) EXPECT_EQ(plugin.add(scans[i]), mapper::PosePlugin::Taken::taken);
    plugin.processUntil(scans.back()->timestamp);
    return plugin.between(scans.front()->timestamp, scans.back()->timestamp);
  };
  auto shuffled = scans;
  std::reverse(shuffled.begin() + 20, shuffled.begin() + 40);
  const auto plain = motionInOrder(scans), other = motionInOrder(shuffled);
  ASSERT_TRUE(plain && other);
  EXPECT_EQ(plain->begin_from_end, other->begin_from_end);
}

TEST(ScanOdometryPlugin, AGapIsBridgedByTheWheelsOrBySearchUnlessItIsLong) {
  const auto log = halfALap();
  const auto broken = [&](double seconds, bool wheels) {
    return [&log, seconds, wheels](CObservation::Ptr observation) {
      const double into = base::secondsBetween(log.begin(), observation->timestamp);
      const bool is_odometry = observation->sensorLabel == "odometry";
      return (into > 8 && into < 8 + seconds) || (is_odometry && !wheels) ? nullptr : observation;
    };
  };
  expectNear(follow(log, broken(3, true)), "with wheels");
  expectNear(follow(log, broken(3, false)), "without wheels");
  EXPECT_EQ(follow(log, broken(11, false)).motion, CPose2D());
}

TEST(ScanOdometryPlugin, AGapThatNothingMeasuresIsEvidence) {
  const auto log = halfALap();
  for (const bool wheels : {true, false}) {
    ScanOdometryPlugin plugin({}, {}, {}, {});
    for (const auto& observation : log.observations()) {
      const double into = base::secondsBetween(log.begin(), observation->timestamp);
      if ((into > 8 && into < 19) || (observation->sensorLabel == "odometry" && !wheels)) continue;
      plugin.add(observation);
    }
    plugin.processUntil(*plugin.coveredUntil());
    const auto evidence = plugin.evidence();
    ASSERT_EQ(evidence.size(), wheels ? 0U : 1U);
    if (wheels) continue;
    EXPECT_EQ(evidence[0].value, 1);
    EXPECT_EQ(evidence[0].says, mapper::Evidence::Says::too_little);
    EXPECT_NE(evidence[0].reason.find("19 s"), std::string::npos) << evidence[0].reason;
  }
}

TEST(ScanOdometryPlugin, AlongABareCorridorItKnowsThatItDoesNotKnow) {
  for (const bool wheels : {true, false}) {
    ScanOdometryPlugin plugin({}, {}, {}, {});
    for (int i = 0; i <= 100; ++i) {
      if (wheels) {
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = "odometry";
        odometry->timestamp = base::stampFromUnix(1e9 + 0.1 * i);
        odometry->odometry = CPose2D(0.05 * i, 0, 0);
        plugin.add(odometry);
      }
      plugin.add(scanOfACorridor(0.1 * i));
    }
    plugin.processUntil(*plugin.coveredUntil());
    const auto measured = plugin.between(base::stampFromUnix(1e9), base::stampFromUnix(1e9 + 10));
    ASSERT_TRUE(measured);
    const double along = std::sqrt(measured->covariance(0, 0)), across = std::sqrt(measured->covariance(1, 1));
    EXPECT_LT(across, 0.2);
    if (wheels) {
      EXPECT_NEAR(measured->begin_from_end.x(), 5, 0.3);
      EXPECT_LT(along, 0.5);
      EXPECT_TRUE(plugin.evidence().empty());
    } else {
      EXPECT_GT(along, 3) << "in 10 s it may have gone 5 m or none";
      ASSERT_EQ(plugin.evidence().size(), 1U);
      EXPECT_GT(plugin.evidence()[0].value, 95);
      EXPECT_EQ(plugin.evidence()[0].says, mapper::Evidence::Says::too_little);
    }
  }
}

// Root mean square of the error over a second of a turning base, [m] [rad].
struct Errors {
  double position = 0, heading = 0;
};
Errors errorsPerSecond(const SimulatedLog& log, double sweep, bool wheels) {
  ScanOdometryOptions options;
  options.sweep = sweep;
  ScanOdometryPlugin plugin(options, {}, {}, {});
  std::vector<base::Stamp> scans;
  for (const auto& observation : log.observations()) {
    if (observation->sensorLabel != "odometry")
      scans.push_back(observation->timestamp);
    else if (!wheels)
      continue;
    plugin.add(observation);
  }
  plugin.processUntil(scans.back());
  Errors errors;
  int spans = 0;
  for (std::size_t i = 0; i + 10 < scans.size(); ++i, ++spans) {
    const auto measured = plugin.between(scans[i], scans[i + 10]);
    if (!measured) {
      ADD_FAILURE() << "lost at scan " << i;
      return {};
    }
    const CPose2D error = CPose2D(measured->begin_from_end) - (log.truthAt(scans[i + 10]) - log.truthAt(scans[i]));
    errors.position += error.norm() * error.norm();
    errors.heading += error.phi() * error.phi();
  }
  return {std::sqrt(errors.position / spans), std::sqrt(errors.heading / spans)};
}

// In a long curve all scans are skewed in the same way: the motion is wrong where curves begin and end.
TEST(ScanOdometryPlugin, ASweepIsTakenOutOfTheScansOfATurningBase) {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  options.speed = 1;
  options.laps = 2;
  constexpr double kSweep = 0.1;  // [s] the whole time between two scans
  options.lasers.front().sweep = kSweep;
  const SimulatedLog log(options);
  for (const bool wheels : {true, false}) {
    const auto raw = errorsPerSecond(log, 0, wheels), straight = errorsPerSecond(log, kSweep, wheels);
    EXPECT_GT(raw.heading, 2 * kDegree);
    EXPECT_LT(straight.heading, raw.heading / 4) << "wheels: " << wheels;
    EXPECT_LT(straight.position, raw.position / 4) << "wheels: " << wheels;
  }
}

TEST(ScanOdometryPlugin, OfScansWithASweepAllTimeSinceTheFirstStampIsCovered) {
  ScanOdometryOptions options;
  options.sweep = 0.08;
  ScanOdometryPlugin plugin(options, {}, {}, {});
  std::vector<base::Stamp> scans;
  for (const auto& observation : halfALap().observations()) {
    plugin.add(observation);
    if (observation->sensorLabel != "odometry") scans.push_back(observation->timestamp);
  }
  plugin.processUntil(scans.back());
  ASSERT_TRUE(plugin.coveredUntil());
  EXPECT_TRUE(plugin.between(scans.front(), *plugin.coveredUntil()));
  EXPECT_EQ(*plugin.coveredUntil(), scans.back());
}

/// Mean of e' C^-1 e over some logs, with the error e and its covariance C: 3 if C is right.
double normalizedSquares(const ScanOdometryOptions& options) {
  double squares = 0;
  constexpr int kLogs = 20;
  for (int seed = 1; seed <= kLogs; ++seed) {
    testing::SimulatedLogOptions world;
    world.laps = 0.3;
    world.seed = seed;
    const auto measured = follow(
        SimulatedLog(world), [](auto observation) { return observation; }, options);
    const CPose2D error = measured.truth - measured.motion;  // in the frame of the end, as the covariance is
    EXPECT_LT(error.norm(), 0.05);
    const Eigen::Vector3d e(error.x(), error.y(), error.phi());
    squares += e.dot(measured.covariance.ldlt().solve(e));
  }
  return squares / kLogs;
}

TEST(ScanOdometryPlugin, TheCovarianceOfTheMatchesIsThatOfTheErrors) {
  ScanOdometryOptions options;
  options.point_sigma = testing::SimulatedLaser().sigma;
  options.position_noise_per_root_m = options.yaw_noise_per_root_m = options.yaw_noise_per_root_turn = 0;
  const double squares = normalizedSquares(options);
  RecordProperty("normalized_squares", std::to_string(squares));
  EXPECT_LT(squares, 6) << "of three degrees of freedom";
  EXPECT_GT(squares, 0.5);
}

// Real floors, walls and mountings cause further errors, which a simulated world lacks: the covariance must include
// them, and still be small enough to be useful.
TEST(ScanOdometryPlugin, ItsCovarianceHasRoomForARealWorldButNotMore) {
  EXPECT_LT(normalizedSquares({}), 0.1);
  const auto log = halfALap();
  const auto measured = follow(log, [](auto observation) { return observation; });
  const double travel = log.lapLength() / 2;
  EXPECT_LT(std::sqrt(measured.covariance.topLeftCorner<2, 2>().trace()), 0.015 * travel);
  EXPECT_LT(std::sqrt(measured.covariance(2, 2)), 2 * kDegree);
}

}  // namespace
}  // namespace omnimapper::plugins::scan_odometry_plugin_test
