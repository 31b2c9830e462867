#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/PlanDrawing.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "ReachableRooms.h"

namespace plan_seed_test {
namespace {

using namespace omnimapper;
using Eigen::Vector2d;

constexpr int kSeeds = 10;
const char* const kGenerators[] = {"home", "office", "laboratory"};

sim::WorldPlan generate(const std::string& generator, int plan_seed, int seed = 1) {
  sim::WorldOptions options;
  options.generator = generator;
  options.plan_seed = plan_seed;
  options.seed = seed;
  return sim::generate(options, "test");
}

// The plan of a generator and a seed, made once for all tests.
const sim::WorldPlan& planOf(const std::string& generator, int plan_seed) {
  static std::map<std::pair<std::string, int>, sim::WorldPlan> plans;
  const auto key = std::make_pair(generator, plan_seed);
  auto found = plans.find(key);
  if (found == plans.end()) found = plans.emplace(key, generate(generator, plan_seed)).first;
  return found->second;
}

// All rooms and openings as a text that is exact in every bit.
std::string buildingOf(const sim::WorldPlan& plan) {
  std::ostringstream text;
  text.precision(17);
  for (const sim::RoomPlan& room : plan.rooms) {
    text << room.name << ' ' << room.height << ' ' << room.wall << ' ' << room.floor;
    for (const Vector2d& corner : room.outline) text << ' ' << corner.transpose();
    text << '\n';
  }
  for (const sim::OpeningPlan& opening : plan.openings) {
    text << opening.name << ' ' << opening.rooms[0] << ' ' << opening.rooms[1] << ' ' << opening.x << ' ' << opening.y
         << ' ' << opening.width << ' ' << opening.hinge_right << '\n';
  }
  return text.str();
}

struct Size {
  double x = 0, y = 0, height = 0;
};
Size sizeOf(const sim::RoomPlan& room) {
  const sim::Bounds bounds = sim::boundsOf(room.outline);
  return {bounds.high.x() - bounds.low.x(), bounds.high.y() - bounds.low.y(), room.height};
}

bool isCorridor(const sim::RoomPlan& room) {
  return room.kind == "corridor" || room.kind == "hallway";
}

// Sizes of a generator's rooms in its fixed plan, and of rooms that only drawn plans have.
std::map<std::string, Size> nominalSizes(const std::string& generator) {
  std::map<std::string, Size> sizes;
  for (const sim::RoomPlan& room : planOf(generator, 0).rooms) sizes[room.name] = sizeOf(room);
  if (generator == "office") sizes["office_133"] = sizes["office_135"] = {4.4, 5.5, 2.7};
  if (generator == "office") sizes["office_135"].x = 4.38;
  if (generator == "laboratory") sizes["meeting_room"] = {4.46, 5, 2.7};
  return sizes;
}

TEST(PlanSeed, zeroIsTheFixedPlan) {
  struct Row {
    const char *generator, *room;
    double low_x, low_y, high_x, high_y, height;
  };
  const Row rows[] = {
      {"home", "living_room", 0, 0, 5.4, 4.6, 2.6},         {"home", "kitchen", 5.52, 0, 9.4, 4.6, 2.6},
      {"home", "hallway", 0, 4.72, 9.4, 6.1, 2.6},          {"home", "bedroom", 0, 6.22, 4.2, 9.8, 2.6},
      {"home", "bathroom", 4.32, 6.22, 6.5, 8.9, 2.6},      {"home", "study", 6.62, 6.22, 9.4, 9.8, 2.6},
      {"office", "atrium", 19.12, 2.12, 33.88, 17.88, 6.0}, {"office", "office_124", 26, 20.12, 30.4, 24.6, 2.7},
      {"laboratory", "laboratory", 0, 0, 14, 10, 3.4},      {"laboratory", "storage_212", 4.72, 11.74, 8.4, 15.8, 2.7}};
  for (const Row& row : rows) {
    const sim::WorldPlan& plan = planOf(row.generator, 0);
    const auto room =
        std::find_if(plan.rooms.begin(), plan.rooms.end(), [&](const sim::RoomPlan& r) { return r.name == row.room; });
    ASSERT_NE(room, plan.rooms.end()) << row.room;
    EXPECT_EQ(room->outline[0], Vector2d(row.low_x, row.low_y)) << row.room;
    EXPECT_EQ(room->outline[2], Vector2d(row.high_x, row.high_y)) << row.room;
    EXPECT_EQ(room->height, row.height) << row.room;
  }
  const sim::OpeningPlan entrance = planOf("home", 0).openings[6];
  EXPECT_EQ(Vector2d(entrance.x, entrance.y), Vector2d(0, 5.41));
  EXPECT_EQ(planOf("home", 0).openings.size(), 13u);
  EXPECT_EQ(planOf("office", 0).rooms.size(), 12u);
  EXPECT_EQ(planOf("office", 0).openings.size(), 32u);
  EXPECT_EQ(planOf("laboratory", 0).rooms.size(), 7u);
  EXPECT_EQ(planOf("laboratory", 0).openings.size(), 11u);
}

TEST(PlanSeed, onePlanSeedIsOnePlanAndAnotherAnother) {
  for (const char* generator : kGenerators) {
    std::set<std::string> plans;
    for (int plan_seed = 0; plan_seed <= kSeeds; ++plan_seed) plans.insert(buildingOf(planOf(generator, plan_seed)));
    EXPECT_EQ(plans.size(), kSeeds + 1u) << generator;
    const std::string drawing = sim::drawPlan(sim::makeWorld(planOf(generator, 3)));
    EXPECT_EQ(drawing, sim::drawPlan(sim::makeWorld(generate(generator, 3)))) << generator;
    // The seed of the furniture does not change the building.
    const sim::WorldPlan refurnished = generate(generator, 3, 2);
    EXPECT_EQ(buildingOf(planOf(generator, 3)), buildingOf(refurnished)) << generator;
    EXPECT_NE(drawing, sim::drawPlan(sim::makeWorld(refurnished))) << generator;
  }
}

TEST(PlanSeed, sizesAreWithinTheirBounds) {
  for (const char* generator : kGenerators) {
    auto nominal = nominalSizes(generator);
    for (int plan_seed = 1; plan_seed <= kSeeds; ++plan_seed) {
      SCOPED_TRACE(std::string(generator) + " " + std::to_string(plan_seed));
      for (const sim::RoomPlan& room : planOf(generator, plan_seed).rooms) {
        SCOPED_TRACE(room.name);
        ASSERT_TRUE(nominal.count(room.name));
        const Size size = sizeOf(room), fixed = nominal[room.name];
        if (isCorridor(room)) {
          EXPECT_GE(std::min(size.x, size.y), 1.5 - 0.006);
          EXPECT_LE(std::min(size.x, size.y), 2.4 + 0.006);
        } else {
          EXPECT_GE(size.x, 0.8 * fixed.x);
          EXPECT_LE(size.x, 1.3 * fixed.x);
          EXPECT_GE(size.y, 0.8 * fixed.y);
          EXPECT_LE(size.y, 1.3 * fixed.y);
        }
        EXPECT_GE(size.height, fixed.height > 3 ? 0.88 * fixed.height : 2.4);
        EXPECT_LE(size.height, fixed.height > 3 ? 1.12 * fixed.height : 3.0);
      }
    }
  }
}

// Distance between two rooms along the axis in which they do not overlap; none if they face each other nowhere.
double wallBetween(const sim::RoomPlan& a, const sim::RoomPlan& b) {
  const sim::Bounds first = sim::boundsOf(a.outline), second = sim::boundsOf(b.outline);
  const Vector2d gap = (second.low - first.high).cwiseMax(first.low - second.high);
  return gap.minCoeff() < 0 ? gap.maxCoeff() : 0;
}

TEST(PlanSeed, neighboursShareWallsOfOneThickness) {
  for (const char* generator : kGenerators) {
    for (int plan_seed = 1; plan_seed <= kSeeds; ++plan_seed) {
      const sim::WorldPlan& plan = planOf(generator, plan_seed);
      double thickness = 0;
      for (const sim::RoomPlan& a : plan.rooms) {
        for (const sim::RoomPlan& b : plan.rooms) {
          const double wall = wallBetween(a, b);
          if (wall <= 1e-6 || wall > 0.5) continue;
          if (thickness == 0) thickness = wall;
          ASSERT_NEAR(wall, thickness, 1e-9) << generator << ' ' << plan_seed << ' ' << a.name << ' ' << b.name;
        }
      }
      EXPECT_GE(thickness, 0.08 - 1e-9) << generator << ' ' << plan_seed;
      EXPECT_LE(thickness, 0.24 + 1e-9) << generator << ' ' << plan_seed;
    }
  }
}

TEST(PlanSeed, aRobotComesToEveryRoomOfEveryPlan) {
  for (const char* generator : kGenerators) {
    for (int plan_seed = 1; plan_seed <= kSeeds; ++plan_seed) {
      const auto missing = reachable_rooms::unreachableRooms(sim::makeWorld(planOf(generator, plan_seed)));
      EXPECT_TRUE(missing.empty()) << generator << ' ' << plan_seed << ": " << missing.front();
    }
  }
}

TEST(PlanSeed, roomsComeAndGo) {
  const auto countWith = [](const std::string& generator, const std::string& name) {
    int count = 0;
    for (int plan_seed = 1; plan_seed <= kSeeds; ++plan_seed) {
      const auto& rooms = planOf(generator, plan_seed).rooms;
      count += std::any_of(rooms.begin(), rooms.end(), [&](const sim::RoomPlan& r) { return r.name == name; });
    }
    return count;
  };
  const std::pair<const char*, const char*> rooms[] = {
      {"home", "study"},        {"office", "atrium"},          {"office", "kitchen"},
      {"office", "office_133"}, {"laboratory", "storage_212"}, {"laboratory", "meeting_room"}};
  for (const auto& [generator, room] : rooms) {
    EXPECT_GE(countWith(generator, room), 1) << generator << ' ' << room;
    EXPECT_LE(countWith(generator, room), kSeeds - 1) << generator << ' ' << room;
  }
}

TEST(PlanSeed, isRefusedWhereThereIsOnePlanOnly) {
  for (const char* generator : {"none", "two_offices", "loop", "corridor_loop", "box", "road"}) {
    try {
      generate(generator, 1);
      ADD_FAILURE() << generator;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
      const std::string what = error.what();
      EXPECT_NE(what.find("test: [world] plan_seed: 1: "), std::string::npos) << what;
      EXPECT_NE(what.find(generator), std::string::npos) << what;
      EXPECT_NE(what.find("laboratory"), std::string::npos) << what;
    }
  }
}

}  // namespace
}  // namespace plan_seed_test
