#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/FloorPlan.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <cmath>
#include <random>

// Sessions in places that look alike or show little: they may stay unaligned, but must not be aligned, or located,
// where they are not.
namespace omnimapper::mapper::wrong_places_test {
namespace {

using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using testing::FloorPlan;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

constexpr double kPi = 3.14159265358979;

struct Drive {
  Observations observations;
  std::vector<std::pair<base::Stamp, CPose2D>> truth;  // world_from_base, of each scan

  CPose2D at(base::Stamp stamp) const {
    return std::min_element(truth.begin(), truth.end(),
                            [&](const auto& a, const auto& b) {
                              return std::abs(base::secondsBetween(a.first, stamp)) <
                                     std::abs(base::secondsBetween(b.first, stamp));
                            })
        ->second;
  }
};

mrpt::obs::CObservation::Ptr scanAt(const FloorPlan& plan, const CPose2D& pose, base::Stamp stamp,
                                    std::mt19937& generator) {
  constexpr std::size_t kBeams = 181;
  constexpr double kMost = 20;  // [m]
  std::normal_distribution<double> noise(0, 0.01);
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->timestamp = stamp;
  scan->sensorLabel = "laser";
  scan->aperture = static_cast<float>(kPi);
  scan->rightToLeft = true;
  scan->maxRange = static_cast<float>(kMost);
  scan->resizeScan(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double angle = pose.phi() - kPi / 2 + kPi * static_cast<double>(i) / (kBeams - 1);
    const double range = plan.distanceToWall({pose.x(), pose.y()}, {std::cos(angle), std::sin(angle)});
    scan->setScanRange(i, static_cast<float>(range < kMost ? range + noise(generator) : kMost));
    scan->setScanRangeValidity(i, range < kMost);
  }
  return scan;
}

// Drives from point to point at 0.5 m/s and turns on the spot at 0.7 rad/s; the wheels are exact.
Drive drive(const FloorPlan& plan, const std::vector<Eigen::Vector2d>& points, double first_yaw) {
  constexpr double kStep = 0.2, kSpeed = 0.5, kTurn = 0.7;  // [s] [m/s] [rad/s]
  std::mt19937 generator(5);
  Drive drive;
  CPose2D pose(points.front().x(), points.front().y(), first_yaw);
  const CPose2D start = pose;
  base::Stamp stamp = base::stampFromUnix(1'700'000'000);
  const auto record = [&] {
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->timestamp = stamp;
    odometry->sensorLabel = "odometry";
    odometry->odometry = pose - start;
    drive.observations.push_back(odometry);
    drive.observations.push_back(scanAt(plan, pose, stamp, generator));
    drive.truth.emplace_back(stamp, pose);
    stamp += base::durationFromSeconds(kStep);
  };
  record();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d way = points[i] - Eigen::Vector2d(pose.x(), pose.y());
    const double turn = mrpt::math::wrapToPi(std::atan2(way.y(), way.x()) - pose.phi());
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / (kTurn * kStep)));
    const double yaw = pose.phi();
    for (int k = 1; k <= turns; ++k) {
      pose.phi(yaw + turn * k / turns);
      record();
    }
    const int steps = static_cast<int>(std::ceil(way.norm() / (kSpeed * kStep)));
    const Eigen::Vector2d from(pose.x(), pose.y());
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Vector2d p = from + way * k / steps;
      pose = CPose2D(p.x(), p.y(), pose.phi());
      record();
    }
  }
  return drive;
}

struct Outcome {
  bool is_aligned;
  double error;           // [m] of the worst key frame of the new session, where the map says it is
  int located_wrong = 0;  // estimates of a localization that count as located, more than 0.5 m or 10 deg off
  int located = 0;
};

// Maps the first drive, then continues, or localizes in, its map with the second.
Outcome outcomeOf(const Drive& first, const Drive& second, const SessionOptions& options, bool localize) {
  testing::ScratchFolder folder;
  const auto before = testing::makeEngine(testing::kLaserIni);
  testing::run(*before, first.observations);
  const auto path = folder / "map.omnimap";
  derived::mapFileToAsk(before->view()).write(path);
  auto saved = derived::readMap(path, registeredKinds());
  const auto start = options.startOn(saved.map);
  const auto engine = testing::makeEngine(testing::kLaserIni, {}, 1, localize);
  if (localize)
    engine->sessions().localizeIn(std::move(saved), start, 30);
  else
    engine->sessions().continueFrom(std::move(saved), start);
  testing::run(*engine, second.observations);
  const auto view = engine->view();
  const CPose2D world_from_map = first.truth.front().second;  // the map begins at its first key frame
  const auto errorOf = [&](const CPose3D& map_from_base, base::Stamp stamp) {
    return (world_from_map + CPose2D(map_from_base)) - second.at(stamp);
  };
  Outcome outcome{view.map.sessions.back().aligned, 0};
  for (const auto& frame : view.map.key_frames) {
    if (frame.id.session == 1)
      outcome.error = std::max(outcome.error, errorOf(frame.map_from_base, frame.stamp).norm());
  }
  for (const auto& estimate : view.localization) {
    if (!estimate.located()) continue;
    ++outcome.located;
    const auto error = errorOf(estimate.map_from_base, estimate.stamp);
    outcome.located_wrong += error.norm() > 0.5 || std::abs(error.phi()) > 10 * kPi / 180;
  }
  return outcome;
}

void expectNoWrongPlace(const Drive& first, const Drive& second, const SessionOptions& options,
                        const std::string& what) {
  const auto continued = outcomeOf(first, second, options, false);
  if (continued.is_aligned) {
    EXPECT_LT(continued.error, 0.5) << what;
  }
  const auto localized = outcomeOf(first, second, options, true);
  EXPECT_EQ(localized.located_wrong, 0) << what << ": of " << localized.located;
}

SessionOptions startingAt(double x, double y, double yaw) {
  SessionOptions options;
  options.start = SessionOptions::Start::pose;
  options.start_x = x, options.start_y = y, options.start_yaw = yaw;
  return options;
}

SessionOptions startingAnywhere() {
  SessionOptions options;
  options.start = SessionOptions::Start::anywhere;
  return options;
}

// Two rooms of 5 m x 4 m, one the mirror image of the other, at both ends of a corridor of 8 m.
FloorPlan mirroredRooms() {
  FloorPlan plan;
  for (const double side : {-1.0, 1.0}) {
    plan.addPolygon({{side * 4, 0.8},
                     {side * 4, 2},
                     {side * 9, 2},
                     {side * 9, -2},
                     {side * 4, -2},
                     {side * 4, -0.8},
                     {side * 4.01, -0.8},
                     {side * 4.01, -1.99},
                     {side * 8.99, -1.99},
                     {side * 8.99, 1.99},
                     {side * 4.01, 1.99},
                     {side * 4.01, 0.8}});
    plan.walls.push_back({{-4, side * 0.8}, {4, side * 0.8}});
    plan.addPolygon({{side * 7, 0.6}, {side * 7.8, 0.6}, {side * 7.8, 1.1}, {side * 7, 1.1}});
  }
  return plan;
}

TEST(WrongPlaces, OfTwoMirrorImagesOnlyTheRightOneIsTaken) {
  const auto plan = mirroredRooms();
  const auto first = drive(plan, {{-6, -1}, {-5, 0}, {5, 0}, {6, -1}, {8, -1}, {6, -1}, {5, 0}, {-5, 0}, {-6, -1}}, 0);
  const std::vector<Eigen::Vector2d> in_the_right_room{{5.5, -1}, {8, -1}, {8, 0}, {6, 0}, {5.5, -1}, {8, -1}};
  const auto second = drive(plan, in_the_right_room, 0);
  expectNoWrongPlace(first, second, startingAnywhere(), "anywhere");
  // A start that is said to be in the right room, at (5.5, -1) of the plan, is taken.
  const auto right = outcomeOf(first, second, startingAt(11.5, 0, 0), false);
  EXPECT_TRUE(right.is_aligned);
  EXPECT_LT(right.error, 0.5);
}

// A start that somebody gives wrong in such a hall cannot be told from a right one.
TEST(WrongPlaces, AnEmptyHallLooksTheSameFromFourSides) {
  FloorPlan plan;
  plan.addPolygon({{-6, -6}, {6, -6}, {6, 6}, {-6, 6}});
  const auto first = drive(plan, {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-3, -3}}, 0);
  const auto second = drive(plan, {{3, 3}, {-3, 3}, {-3, -2}, {2, -2}}, kPi);
  expectNoWrongPlace(first, second, startingAnywhere(), "anywhere");
}

TEST(WrongPlaces, AMapOfOneWallDeterminesNoPlaceAlongIt) {
  FloorPlan plan;
  plan.walls.push_back({{-30, 2}, {30, 2}});
  const auto first = drive(plan, {{-4, 0}, {4, 0}}, 0);
  const auto second = drive(plan, {{0, 0}, {6, 0}}, 0);
  expectNoWrongPlace(first, second, startingAnywhere(), "anywhere");
  expectNoWrongPlace(first, second, startingAt(0, 0, 0), "a start 4 m back");
}

TEST(WrongPlaces, ASessionOfOneScanIsNotAlignedByItself) {
  const auto plan = FloorPlan::ring();
  const auto first = drive(plan, {{0, 0}, {6, 0}}, 0);
  Drive second = drive(plan, {{2, 0}, {3, 0}}, 0);
  second.observations.resize(2);
  const auto anywhere = outcomeOf(first, second, startingAnywhere(), false);
  EXPECT_FALSE(anywhere.is_aligned) << "one scan shows one place";
  expectNoWrongPlace(first, second, startingAt(2, 0, 0), "a start that was said");
}

TEST(WrongPlaces, AStartThatFacesTheOtherWayIsSetRightOrNotTaken) {
  const auto plan = FloorPlan::ring();
  const auto first = drive(plan, {{0, 0}, {7, 0}, {0, 0}}, 0);
  const auto second = drive(plan, {{1, 0}, {7, 0}, {1, 0}}, 0);
  expectNoWrongPlace(first, second, startingAt(1, 0, kPi), "turned by 180 deg");
  const auto right = outcomeOf(first, second, startingAt(1, 0, 0), false);
  EXPECT_TRUE(right.is_aligned) << "a right start is taken";
}

}  // namespace
}  // namespace omnimapper::mapper::wrong_places_test
