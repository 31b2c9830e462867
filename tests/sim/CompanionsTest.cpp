// People who accompany the robot keep their places, and keep out of walls, furniture, the robot and each other.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim/Companions.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/sim_world/Footprint.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "SmallWorlds.h"

namespace companions_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;
using Eigen::Vector2d;
using Place = sim::CompanionPlan::Place;

sim::CompanionPlan companion(const std::string& name, Place place, double distance = 1, double side = 0) {
  sim::CompanionPlan plan;
  plan.name = name;
  plan.place = place;
  plan.distance = distance;
  plan.side = side;
  plan.seed = 7;
  return plan;
}

/// A world with a drive and companions.
struct Walked {
  sim::World world;
  sim::Track map_from_base;

  Walked(sim::World empty, const std::string& robot, const std::vector<sim::CompanionPlan>& companions)
      : world(std::move(empty)),
        map_from_base(sim::planDrive(base::Config::fromText("[robot]\n" + robot, "test.ini"), world)) {
    sim::WorldPlan plan;
    plan.file = "test.ini";
    plan.companions = companions;
    sim::addCompanions(world, plan, map_from_base, 0.25);
  }
  double end() const { return map_from_base.places().back().time; }
  Vector2d robotAt(double time) const { return map_from_base.at(time)->translation.head<2>(); }
};

Vector2d at(const sim::Person& person, double time) {
  return sim::jointOf(person, "torso").in_map.at(time)->translation.head<2>();
}

double distanceToObstacle(const sim::World& world, const Vector2d& point) {
  double nearest = 1e9;
  for (const auto& ring : world.obstacles) {
    if (sim::contains(ring, point)) return 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
      nearest = std::min(nearest, sim::distanceToSegment(point, ring[i], ring[(i + 1) % ring.size()]));
  }
  return nearest;
}

/// Extremes over the whole drive, at the rate of the postures.
struct Extremes {
  double to_robot = 1e9, to_obstacle = 1e9, to_others = 1e9, speed = 0;
};

Extremes extremesOf(const sim::World& world, const sim::Track& map_from_base, const sim::Person& person) {
  constexpr double kStep = 0.05;
  Extremes most;
  for (double time = 0; time < map_from_base.places().back().time + 5; time += kStep) {
    const Vector2d place = at(person, time), robot = map_from_base.at(time)->translation.head<2>();
    EXPECT_TRUE(place.allFinite()) << person.name << " at " << time;
    most.to_robot = std::min(most.to_robot, (place - robot).norm());
    most.to_obstacle = std::min(most.to_obstacle, distanceToObstacle(world, place));
    most.speed = std::max(most.speed, (at(person, time + kStep) - place).norm() / kStep);
    for (const sim::Person& other : world.people) {
      if (&other != &person) most.to_others = std::min(most.to_others, (at(other, time) - place).norm());
    }
  }
  return most;
}

void expectWellBehaved(const sim::World& world, const sim::Track& map_from_base) {
  ASSERT_FALSE(world.people.empty());
  for (const sim::Person& person : world.people) {
    const Extremes most = extremesOf(world, map_from_base, person);
    EXPECT_GE(most.to_robot, 0.45) << person.name;
    EXPECT_GE(most.to_obstacle, 0.15) << person.name;
    EXPECT_GE(most.to_others, 0.25) << person.name;
    EXPECT_LE(most.speed, 2) << person.name;
  }
}

const std::string kStraight = "mode = waypoints\nwaypoints = 2 2, 22 2\nmax_speed_m_s = 0.5\n";

TEST(Companions, onAStraightDriveTheyKeepTheirDistances) {
  const Walked walked(oneRoom(26, 4), kStraight,
                      {companion("ann", Place::ahead, 1.2), companion("bob", Place::behind, 0.9),
                       companion("cid", Place::beside, 1, 0.8), companion("dot", Place::ahead, 1, -0.7)});
  // The robot is at its full speed from 1 s on; it brakes in the last second.
  for (double time = 4; time < walked.end() - 4; time += 0.37) {
    const Vector2d robot = walked.robotAt(time);
    EXPECT_NEAR(at(walked.world.people[0], time).x(), robot.x() + 1.2, 0.003) << time;
    EXPECT_NEAR(at(walked.world.people[0], time).y(), 2, 0.003) << time;
    EXPECT_NEAR(at(walked.world.people[1], time).x(), robot.x() - 0.9, 0.003) << time;
    EXPECT_NEAR(at(walked.world.people[2], time).x(), robot.x(), 0.003) << time;
    EXPECT_NEAR(at(walked.world.people[2], time).y(), 2.8, 0.003) << time;
    EXPECT_NEAR(at(walked.world.people[3], time).y(), 1.3, 0.003) << time;
  }
  expectWellBehaved(walked.world, walked.map_from_base);
}

TEST(Companions, thePersonAheadGoesOnBeyondTheEndOfTheDriveAndStandsThere) {
  const Walked walked(oneRoom(26, 4), kStraight, {companion("ann", Place::ahead)});
  const Vector2d after = at(walked.world.people[0], walked.end() + 4);
  EXPECT_NEAR(after.x(), 23, 0.01);
  EXPECT_EQ(after, at(walked.world.people[0], walked.end() + 400));
}

TEST(Companions, besideTheRobotTheyFallInWhereTheDoorIsNarrow) {
  const Walked walked(threeRooms(), "mode = waypoints\nwaypoints = 1 2, 7 2\n",
                      {companion("ann", Place::beside, 1, 0.75)});
  expectWellBehaved(walked.world, walked.map_from_base);
  const sim::Person& ann = walked.world.people[0];
  EXPECT_NEAR(at(ann, 1).y() - walked.robotAt(1).y(), 0.75, 0.1);
  EXPECT_NEAR(at(ann, walked.end()).y() - 2, 0.75, 0.1);
  for (double time = 0; time < walked.end(); time += 0.1) {
    if (std::abs(at(ann, time).x() - 4) < 0.1) {
      EXPECT_LT(at(ann, time).y(), 2.4 - 0.15) << "beside the door";
    }
  }
}

TEST(Companions, oneWhoCrossesThePathIsNowOnOneSideAndNowOnTheOther) {
  const Walked walked(oneRoom(26, 4), kStraight, {companion("ann", Place::crossing, 2)});
  int crossings = 0;
  for (double time = 0; time < walked.end() - 0.1; time += 0.1) {
    const double now = at(walked.world.people[0], time).y() - 2, next = at(walked.world.people[0], time + 0.1).y() - 2;
    crossings += now * next < 0 ? 1 : 0;
    EXPECT_LE(std::abs(now), 1);
  }
  EXPECT_GE(crossings, 2);
  EXPECT_LE(crossings, 8);
  expectWellBehaved(walked.world, walked.map_from_base);
}

TEST(Companions, oneWhoStopsWalksAheadAndWaitsForTheRobot) {
  const Walked walked(oneRoom(26, 4), kStraight, {companion("ann", Place::stops)});
  double farthest = 0, waited = 0;
  for (double time = 4; time < walked.end() - 4; time += 0.1) {
    const Vector2d person = at(walked.world.people[0], time);
    farthest = std::max(farthest, (person - walked.robotAt(time)).norm());
    waited += at(walked.world.people[0], time + 0.1) == person ? 0.1 : 0;
    EXPECT_GE((person - walked.robotAt(time)).norm(), 0.99);
  }
  EXPECT_GT(farthest, 1.8);
  EXPECT_GT(waited, 2);
}

TEST(Companions, aRobotThatStandsHasItsCompanyAroundIt) {
  const Walked walked(oneRoom(8, 6), "mode = still\nstart = 4 3 0\nduration_s = 30\n",
                      {companion("ann", Place::ahead), companion("bob", Place::behind), companion("cid", Place::beside),
                       companion("dot", Place::stops, 2), companion("eve", Place::crossing, 1.5)});
  EXPECT_LT((at(walked.world.people[0], 10) - Vector2d(5, 3)).norm(), 0.01);
  EXPECT_LT((at(walked.world.people[1], 10) - Vector2d(3, 3)).norm(), 0.01);
  EXPECT_LT((at(walked.world.people[2], 10) - Vector2d(4, 3.75)).norm(), 0.01);
  EXPECT_LT((at(walked.world.people[3], 10) - Vector2d(6, 3)).norm(), 0.4);
  expectWellBehaved(walked.world, walked.map_from_base);
}

TEST(Companions, outsideOfTheirTimeTheyStand) {
  sim::CompanionPlan ann = companion("ann", Place::beside);
  ann.from = 10;
  ann.until = 20;
  const Walked walked(oneRoom(26, 4), kStraight, {ann});
  const auto ofAnn = [&](double time) { return at(walked.world.people[0], time); };
  EXPECT_LT((ofAnn(0) - ofAnn(8)).norm(), 0.02);
  EXPECT_NEAR(ofAnn(15).x(), walked.robotAt(15).x(), 0.01);
  EXPECT_LT((ofAnn(22) - ofAnn(40)).norm(), 0.02);
}

TEST(Companions, withoutRoomTheyAreRefusedWithTheirSection) {
  sim::World closet = oneRoom(0.9, 0.9);
  try {
    const Walked walked(closet, "mode = still\nstart = 0.45 0.45 0\n", {companion("ann", Place::ahead)});
    FAIL() << "there is no room for a person";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    EXPECT_NE(std::string(error.what()).find("test.ini: [ann] place"), std::string::npos) << error.what();
  }
}

base::Config generated(const std::string& generator, const std::string& keys) {
  return base::Config::fromText("[simulation]\nsensors = odometry, laser\n[world]\ngenerator = " + generator + "\n" +
                                    keys +
                                    "\n[robot]\nmode = tour\nduration_s = 120\n[odometry]\nclass = Odometry\n"
                                    "[laser]\nclass = Laser2d\nmodel = hokuyo_utm30\nx_m = 0.15\nz_m = 0.35\n",
                                "test.ini");
}

class CompanionsInPlaces : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(CompanionsInPlaces, keepOutOfWallsFurnitureRobotAndEachOther) {
  const auto& [generator, keys] = GetParam();
  const sim::DrivenWorld driven = sim::readDrivenWorld(generated(generator, keys));
  expectWellBehaved(driven.world, driven.map_from_base);
}

INSTANTIATE_TEST_SUITE_P(Generated, CompanionsInPlaces,
                         ::testing::Values(std::tuple("home", "companions = crowd"),
                                           std::tuple("home", "companions = guide\nplan_seed = 3"),
                                           std::tuple("laboratory", "companions = group\nplan_seed = 2"),
                                           std::tuple("office", "companions = guests")));

TEST(CompanionsInRuns, changeNeitherTheDriveNorTheOdometryAndAreTheSameTwice) {
  const sim::Simulation alone(generated("home", "")), led(generated("home", "companions = guide")),
      again(generated("home", "companions = guide"));
  ASSERT_EQ(alone.mapFromBase().places().size(), led.mapFromBase().places().size());
  for (std::size_t i = 0; i < alone.mapFromBase().places().size(); i += 50) {
    EXPECT_EQ(alone.mapFromBase().places()[i].map_from_body->translation,
              led.mapFromBase().places()[i].map_from_body->translation);
  }
  const auto poseOf = [](const sim::Simulation& simulation, int k) {
    const auto measurement = simulation.sensors()[0]->measure(k);
    return dynamic_cast<const mrpt::obs::CObservationOdometry&>(*measurement.observation).odometry;
  };
  for (int k = 0; k < alone.sensors()[0]->count(); k += 25) EXPECT_EQ(poseOf(alone, k), poseOf(led, k));
  // The bodies of companions come after all others, so that the labels of surfaces stay.
  for (std::size_t i = 0; i < alone.world().bodies.size(); ++i)
    EXPECT_EQ(alone.world().bodies[i].name, led.world().bodies[i].name);
  const sim::Person &one = led.world().people[0], &other = again.world().people[0];
  for (double time = 0; time < 120; time += 0.05) EXPECT_EQ(at(one, time), at(other, time)) << time;
}

}  // namespace
}  // namespace companions_test
