// Places where little or nothing stays as it was: crowds, and a wall that opens.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "laser2d/ScanOdometryPlugin.h"

namespace omnimapper::plugins::crowd_test {
namespace {

using Eigen::Vector2d;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose2D;
using testing::FloorPlan;

constexpr double kDegree = base::option_text::kRadiansPerDegree;

void addBox(FloorPlan& plan, const Vector2d& low, const Vector2d& high) {
  plan.addPolygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
}

void addPerson(FloorPlan& plan, const Vector2d& place) {
  addBox(plan, place - Vector2d(0.15, 0.2), place + Vector2d(0.15, 0.2));
}

// What surrounds the laser at a time [s].
using Place = std::function<FloorPlan(double)>;
using Path = std::function<CPose2D(double)>;

struct Drive {
  Place place;
  Path path;
  double seconds, rate;
  bool has_wheels;
};

struct Outcome {
  bool is_whole = false;  // whether the motion from the first scan to the last is known
  CPose2D error;          // in the frame of the first scan
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double moving_percent = 0;
  bool says_too_little = false;
};

CObservation2DRangeScan::Ptr scanAt(const Drive& drive, double seconds, testing::Dice& dice) {
  constexpr int kBeams = 271;
  constexpr float kReach = 15;
  auto scan = CObservation2DRangeScan::Create();
  scan->sensorLabel = "laser";
  scan->timestamp = base::stampFromUnix(1e9 + seconds);
  scan->aperture = static_cast<float>(270 * kDegree);
  scan->maxRange = kReach;
  scan->resizeScan(kBeams);
  const FloorPlan plan = drive.place(seconds);
  const CPose2D pose = drive.path(seconds);
  for (int i = 0; i < kBeams; ++i) {
    const double angle = pose.phi() + (i - kBeams / 2) * kDegree;
    const double range = plan.distanceToWall({pose.x(), pose.y()}, {std::cos(angle), std::sin(angle)});
    const auto measured = static_cast<float>(range + dice.normal(0.01));
    scan->setScanRange(i, measured);
    scan->setScanRangeValidity(i, measured < kReach);
  }
  return scan;
}

Outcome follow(const Drive& drive) {
  testing::Dice dice(1);
  ScanOdometryPlugin plugin({}, {}, {}, {});
  const int scans = static_cast<int>(drive.seconds * drive.rate);
  for (int i = 0; i <= scans; ++i) {
    const double seconds = i / drive.rate;
    if (drive.has_wheels) {
      auto odometry = mrpt::obs::CObservationOdometry::Create();
      odometry->sensorLabel = "odometry";
      odometry->timestamp = base::stampFromUnix(1e9 + seconds);
      odometry->odometry = drive.path(seconds) - drive.path(0);
      plugin.add(odometry);
    }
    plugin.add(scanAt(drive, seconds, dice));
  }
  const base::Stamp begin = base::stampFromUnix(1e9), end = base::stampFromUnix(1e9 + scans / drive.rate);
  plugin.processUntil(end);
  Outcome outcome;
  const auto measured = plugin.between(begin, end);
  for (const auto& one : plugin.evidence()) {
    if (one.name == "moving_points_percent") outcome.moving_percent = one.value;
    outcome.says_too_little = outcome.says_too_little || one.says == mapper::Evidence::Says::too_little;
  }
  if (!measured) return outcome;
  outcome.is_whole = true;
  const CPose2D motion(measured->begin_from_end), truth = drive.path(scans / drive.rate) - drive.path(0);
  outcome.error =
      CPose2D(motion.x() - truth.x(), motion.y() - truth.y(), mrpt::math::wrapToPi(motion.phi() - truth.phi()));
  const int planar[] = {0, 1, 5};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) outcome.covariance(i, j) = measured->covariance(planar[i], planar[j]);
  return outcome;
}

// Ten people mill about between 0.6 and 3 m from the origin, each on a curve of its own.
FloorPlan amongPeople(double seconds) {
  FloorPlan plan;
  addBox(plan, {-8, -4}, {8, 4});
  addBox(plan, {5, 2}, {5.5, 2.5});
  for (int i = 0; i < 10; ++i) {
    const double around = 2 * M_PI * i / 10 + 0.7 * std::sin((0.11 + 0.013 * i) * seconds + i);
    const double distance = 1.8 + 1.2 * std::sin((0.31 + 0.037 * i) * seconds + 2.3 * i);
    addPerson(plan, distance * Vector2d(std::cos(around), std::sin(around)));
  }
  return plan;
}

TEST(Crowd, ForTenMinutesARobotThatStandsInItStands) {
  for (const bool has_wheels : {true, false}) {
    const auto outcome = follow({amongPeople, [](double) { return CPose2D(); }, 600, 4, has_wheels});
    ASSERT_TRUE(outcome.is_whole) << "wheels: " << has_wheels;
    EXPECT_LT(outcome.error.norm(), 0.05) << "wheels: " << has_wheels;
    EXPECT_LT(std::abs(outcome.error.phi()), 0.5 * kDegree) << "wheels: " << has_wheels;
    EXPECT_GT(outcome.moving_percent, 20) << "wheels: " << has_wheels;
  }
}

// Somebody carries the laser through a hall with pillars, and sways; six people come towards it, and `along` go along.
Outcome carriedThroughHall(double length, int along) {
  // [m] of somebody who begins to walk, and after some seconds walks at 0.9 m/s.
  const auto walked = [](double t) { return 0.9 * (t - 2 * (1 - std::exp(-t / 2))); };
  const auto path = [=](double t) { return CPose2D(walked(t), 0.05 * std::sin(5 * t), 0.1 * std::sin(3 * t)); };
  const auto hall = [=](double t) {
    FloorPlan plan;
    addBox(plan, {-5, -4}, {length, 4});
    for (int i = 0; i < 5; ++i) addBox(plan, {1 + 6. * i, 2.5}, {1.5 + 6. * i, 3});
    for (int i = 0; i < 6; ++i)
      addPerson(plan, {6 + 3. * i - (0.8 + 0.1 * i) * t, (i % 2 == 0 ? 0.7 : -0.8) + 0.1 * i});
    for (int i = 0; i < along; ++i)
      addPerson(plan, {1.2 + 1.1 * i + (0.97 + 0.02 * i) * walked(t), i % 2 == 0 ? 0.9 : -0.7});
    return plan;
  };
  return follow({hall, path, 14, 10, false});
}

TEST(Crowd, ALaserThatIsCarriedThroughItIsFollowedWhereAnEndOfTheHallIsInView) {
  const auto outcome = carriedThroughHall(14, 2);
  ASSERT_TRUE(outcome.is_whole);
  EXPECT_LT(outcome.error.norm(), 0.3) << "of 12.6 m";
  EXPECT_LT(std::abs(outcome.error.phi()), 1.5 * kDegree);
}

// The pillars say that it moves, the people say that it stands, and nobody knows who is right.
TEST(Crowd, ALaserThatIsCarriedThroughItSaysThatItDoesNotKnowWhereNoEndIsInView) {
  const auto outcome = carriedThroughHall(80, 4);
  ASSERT_TRUE(outcome.is_whole);
  EXPECT_LT(std::abs(outcome.error.x()), 3 * std::sqrt(outcome.covariance(0, 0)));
  EXPECT_LT(std::abs(outcome.error.y()), 0.2);
  EXPECT_LT(std::abs(outcome.error.phi()), 1.5 * kDegree);
  EXPECT_TRUE(outcome.says_too_little);
}

// The whole wall ahead opens within 2 s and shows a hall behind it, into which the robot drives; it closes behind it.
TEST(Crowd, AShutterThatOpensIsNeitherAMotionNorAThing) {
  const auto path = [](double t) { return CPose2D(0.4 * t, 0, 0); };
  const auto place = [](double t) {
    FloorPlan plan;
    const double open = t < 5 ? 0 : std::min(2., t - 5), closed = t < 15 ? 0 : std::min(2., t - 15);
    const double half = std::max(0., open - closed);  // [m] half the width of the opening, which grows from the middle
    addBox(plan, {-2, -2.6}, {3, -2.5});
    addBox(plan, {-2, 2.5}, {3, 2.6});
    addBox(plan, {-2.1, -2.6}, {-2, 2.6});
    addBox(plan, {3, half}, {3.1, 6});
    addBox(plan, {3, -6}, {3.1, -half});
    addBox(plan, {3, -6.1}, {12, -6});
    addBox(plan, {3, 6}, {12, 6.1});
    addBox(plan, {12, -6.1}, {12.1, 6.1});
    addBox(plan, {7, 2}, {7.5, 2.5});
    return plan;
  };
  for (const bool has_wheels : {true, false}) {
    const auto outcome = follow({place, path, 20, 10, has_wheels});
    ASSERT_TRUE(outcome.is_whole) << "wheels: " << has_wheels;
    EXPECT_LT(outcome.error.norm(), 0.05) << "wheels: " << has_wheels;
    EXPECT_LT(std::abs(outcome.error.phi()), 0.5 * kDegree) << "wheels: " << has_wheels;
    EXPECT_LT(outcome.moving_percent, 1) << "wheels: " << has_wheels;
  }
}

}  // namespace
}  // namespace omnimapper::plugins::crowd_test
