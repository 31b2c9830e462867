#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim_world/Random.h>

#include "SmallWorlds.h"

namespace drive_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;

sim::Track drive(const std::string& keys, const sim::World& world) {
  return sim::planDrive(base::Config::fromText("[robot]\n" + keys, "test.ini"), world);
}

std::string refusal(const std::string& keys, const sim::World& world) {
  try {
    drive(keys, world);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    return error.what();
  }
  return "";
}

double distanceToObstacle(const sim::World& world, const Eigen::Vector2d& point) {
  double nearest = 1e9;
  for (const auto& obstacle : world.obstacles) {
    for (std::size_t i = 0; i < obstacle.size(); ++i) {
      const Eigen::Vector2d &a = obstacle[i], along = obstacle[(i + 1) % obstacle.size()] - a;
      const double share = std::min(1.0, std::max(0.0, (point - a).dot(along) / along.squaredNorm()));
      nearest = std::min(nearest, (point - a - share * along).norm());
    }
  }
  return nearest;
}

// A room of 8 x 8 m with boxes at places that the seed determines.
sim::World cluttered(std::uint64_t seed) {
  sim::World world = oneRoom(8, 8);
  sim::Random random(seed, {1});
  for (int i = 0; i < 7; ++i) {
    const Eigen::Vector2d low(random.uniform(1, 6), random.uniform(1, 6));
    addBox(world, "box_" + std::to_string(i), low,
           low + Eigen::Vector2d(random.uniform(0.1, 1.2), random.uniform(0.1, 1.2)));
  }
  return world;
}

/// Largest velocities and accelerations of a track, by differences.
struct Extremes {
  double speed = 0, turn = 0, acceleration = 0, turn_acceleration = 0, sideways = 0;
};

Extremes extremesOf(const sim::Track& track) {
  Extremes most;
  const double step = 1.0 / sim::kDriveRate;
  Eigen::Vector2d last_velocity = Eigen::Vector2d::Zero();
  double last_turn = 0;
  for (std::size_t i = 1; i < track.places().size(); ++i) {
    const geometry::Se2 from = geometry::project(*track.places()[i - 1].map_from_body),
                        to = geometry::project(*track.places()[i].map_from_body);
    const Eigen::Vector2d velocity = (to.translation() - from.translation()) / step;
    const double turn = geometry::wrapToPi(to.yaw - from.yaw) / step;
    const double middle = from.yaw + 0.5 * turn * step;
    most.speed = std::max(most.speed, velocity.norm());
    most.turn = std::max(most.turn, std::abs(turn));
    most.acceleration = std::max(most.acceleration, (velocity - last_velocity).norm() / step);
    most.turn_acceleration = std::max(most.turn_acceleration, std::abs(turn - last_turn) / step);
    most.sideways =
        std::max(most.sideways, std::abs(velocity.dot(Eigen::Vector2d(-std::sin(middle), std::cos(middle)))));
    EXPECT_GE(velocity.dot(Eigen::Vector2d(std::cos(middle), std::sin(middle))), -1e-6);
    last_velocity = velocity, last_turn = turn;
  }
  return most;
}

TEST(Drive, aStraightWayTakesTheTimeOfATrapezoid) {
  // 4 m at 0.5 m/s, 0.5 m/s^2: 1 s of speeding up and 1 s of slowing down are 0.5 m, 3.5 m take 7 s.
  const sim::Track track = drive("mode = waypoints\nwaypoints = 1 2, 5 2", oneRoom(6, 4));
  EXPECT_NEAR(track.places().back().time, 9, 0.01 + 1e-9);
  EXPECT_NEAR(track.at(0.5)->translation.x(), 1 + 0.5 * 0.5 * 0.25, 1e-9);
  EXPECT_NEAR(track.at(4.5)->translation.x(), 3, 1e-9);
  EXPECT_NEAR(track.at(9.1)->translation.x(), 5, 1e-9);
}

TEST(Drive, aWayOfMillimetresEnds) {
  const auto track = drive("mode = waypoints\nwaypoints = 1 1, 1.003 1, 3 1\npause_s = 1\n", oneRoom(8, 8));
  EXPECT_GT(track.places().back().time, 4);
  EXPECT_LT(track.places().back().time, 60);
}

TEST(Drive, limitsHoldAndTheRadiusIsKeptOverSeeds) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const sim::World world = cluttered(seed);
    const sim::Track track = drive("rooms = room\nradius_m = 0.3\nlook_around_deg = 90", world);
    const Extremes most = extremesOf(track);
    EXPECT_LE(most.speed, 0.5 * 1.001) << seed;
    EXPECT_LE(most.turn, 1.0 * 1.002) << seed;
    EXPECT_LE(most.acceleration, 0.5 * std::sqrt(2) * 1.02) << seed;
    EXPECT_LE(most.turn_acceleration, 2.0 * 1.05) << seed;
    EXPECT_LE(most.sideways, 1e-4) << seed;
    for (const auto& place : track.places())
      ASSERT_GE(distanceToObstacle(world, place.map_from_body->translation.head<2>()), 0.3)
          << seed << " at " << place.time;
  }
}

TEST(Drive, aTourSeesEveryPlaceThatCanBeSeen) {
  const sim::World world = cluttered(3);
  const sim::Track track = drive("reach_m = 2", world);
  int unseen = 0, count = 0;
  for (double x = 0.4; x < 8; x += 0.4) {
    for (double y = 0.4; y < 8; y += 0.4) {
      const Eigen::Vector2d point(x, y);
      if (distanceToObstacle(world, point) < 0.35) continue;
      bool seen = false;
      for (std::size_t i = 0; i < track.places().size() && !seen; i += 10)
        seen = (track.places()[i].map_from_body->translation.head<2>() - point).norm() < 2;
      ++count, unseen += !seen;
    }
  }
  EXPECT_GT(count, 100);
  EXPECT_LE(unseen, count / 25);
}

TEST(Drive, aTourGoesThroughDoorsAndLeavesOutWhatIsClosed) {
  const sim::World world = threeRooms();
  const sim::Track track = drive("", world);
  const auto visits = sim::visitsOf(world, track);
  ASSERT_EQ(visits.size(), 2u);
  EXPECT_EQ(visits[0].room, 0);
  EXPECT_EQ(visits[1].room, 1);
  EXPECT_NEAR(visits[0].leave, visits[1].enter, 0.011);
  EXPECT_DOUBLE_EQ(visits[1].leave, track.places().back().time);
}

TEST(Drive, waypointsArePassedInOrderAndHeadingsTaken) {
  const sim::World world = threeRooms();
  const sim::Track track =
      drive("mode = waypoints\nwaypoints = 1 1, 7 3 180, left\npause_s = 2\nstart = 3 3 90", world);
  const auto first = geometry::project(*track.at(0));
  EXPECT_NEAR(first.x, 3, 1e-12);
  EXPECT_NEAR(first.yaw, M_PI / 2, 1e-12);
  std::size_t reached = 0;
  const std::vector<Eigen::Vector2d> wanted{{1, 1}, {7, 3}, {2, 2}};
  double waited = 0;
  for (const auto& place : track.places()) {
    const auto pose = geometry::project(*place.map_from_body);
    if (reached < 3 && (pose.translation() - wanted[reached]).norm() < 0.1) ++reached;
    if (reached == 2 && (pose.translation() - wanted[1]).norm() < 1e-9 && std::abs(std::abs(pose.yaw) - M_PI) < 1e-9)
      waited += 0.01;
  }
  EXPECT_EQ(reached, 3u);
  EXPECT_NEAR(waited, 2, 0.05);
}

TEST(Drive, aDurationIsKeptByRepeatingAndCutting) {
  const sim::World world = oneRoom(6, 4);
  const std::string square = "mode = waypoints\nwaypoints = 1 1, 5 1, 5 3, 1 3\n";
  EXPECT_NEAR(drive(square + "duration_s = 100", world).places().back().time, 100, 1e-9);
  EXPECT_NEAR(drive("mode = still\nstart = 2 2\nduration_s = 7", world).places().back().time, 7, 1e-9);
  const double once = drive(square, world).places().back().time;
  EXPECT_GT(drive(square + "repeat = 3", world).places().back().time, 2.9 * once);
}

TEST(Drive, whatCannotBeReachedIsRefusedWithPlaceAndRemedy) {
  const sim::World world = threeRooms();
  const std::string in_wall = refusal("mode = waypoints\nwaypoints = 1 1, 3.9 3.5", world);
  for (const char* part : {"test.ini: [robot] waypoints", "3.9 3.5", "(3.90, 3.50)", "nearest free place is (3.6"})
    EXPECT_NE(in_wall.find(part), std::string::npos) << in_wall;
  const std::string closed = refusal("mode = waypoints\nwaypoints = 1 1, closed", world);
  for (const char* part : {"waypoints: closed", "no path", "nearest free place is (7.6"})
    EXPECT_NE(closed.find(part), std::string::npos) << closed;
  EXPECT_NE(refusal("mode = waypoints\nwaypoints = lefd", world).find("did you mean 'left'"), std::string::npos);
  EXPECT_NE(refusal("rooms = left closed", world).find("rooms: closed"), std::string::npos);
  EXPECT_NE(refusal("mode = waypoints", world).find("waypoints"), std::string::npos);
  EXPECT_NE(refusal("mode = waypoints\nwaypoints = 50 50", world).find("(50.00, 50.00)"), std::string::npos);
}

TEST(Drive, whatReachesFarBeyondThePlanIsInTheWayWhereItIs) {
  sim::World world = oneRoom(6, 4);
  world.obstacles.push_back({{3, 1}, {1e12, 1}, {1e12, 1e12}, {3, 1e12}});
  EXPECT_NE(refusal("mode = waypoints\nwaypoints = 5 3", world).find("(5.00, 3.00)"), std::string::npos);
  EXPECT_NEAR(drive("mode = waypoints\nwaypoints = 1 3, 1 1", world).places().back().map_from_body->translation.y(), 1,
              1e-9);
}

TEST(Drive, theBaseFollowsTheGround) {
  // A ramp that rises 0.1 m a metre along x.
  sim::World world;
  addRoom(world, "ramp", {0, 0}, {10, 4});
  world.bodies.clear();
  addQuad(world, "road", sim::SurfaceKind::road, {-1, -1, -0.1}, {12, 0, 1.2}, {0, 6, 0});
  const sim::Track track = drive("mode = waypoints\nwaypoints = 1 2, 8 2", world);
  const auto pose = *track.at(8);
  EXPECT_NEAR(pose.translation.z(), 0.1 * pose.translation.x(), 1e-9);
  const Eigen::Vector3d forward = pose.rotation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(forward.z() / forward.x(), 0.1, 1e-9);
  EXPECT_NEAR(forward.y(), 0, 1e-12);
}

TEST(Drive, flatFloorsKeepTheBaseFlatExactly) {
  const sim::Track track = drive("", threeRooms());
  for (const auto& place : track.places()) {
    EXPECT_EQ(place.map_from_body->translation.z(), 0);
    EXPECT_EQ(place.map_from_body->rotation.x(), 0);
    EXPECT_EQ(place.map_from_body->rotation.y(), 0);
  }
}

TEST(Drive, aHandSwaysSmoothlyAtEyeHeight) {
  const sim::World world = threeRooms();
  const sim::Track track = drive("handheld = true\neye_height_m = 1.4", world);
  double mean = 0, spread = 0, most = 0;
  const auto& places = track.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double z = places[i].map_from_body->translation.z();
    mean += z / static_cast<double>(places.size());
    spread = std::max(spread, std::abs(z - 1.4));
    if (i < 2) continue;
    const Eigen::Vector3d acceleration =
        (places[i].map_from_body->translation - 2 * places[i - 1].map_from_body->translation +
         places[i - 2].map_from_body->translation) *
        1e4;
    most = std::max(most, acceleration.norm());
  }
  EXPECT_NEAR(mean, 1.4, 0.02);
  EXPECT_GT(spread, 0.01);
  EXPECT_LT(spread, 0.1);
  EXPECT_LT(most, 30);
  sim::World other = world;
  other.seed = 5;
  EXPECT_NE(drive("handheld = true", other).at(3)->translation, drive("handheld = true", world).at(3)->translation);
}

}  // namespace
}  // namespace drive_test
