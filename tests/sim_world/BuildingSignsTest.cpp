// Keys of [world] for the signs of a generated place: styles, repeated words, exits and announcements.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/Materials.h>
#include <omnimapper/sim_world/SignMaking.h>

#include <algorithm>
#include <map>
#include <set>

namespace building_signs_test {
namespace {

using namespace omnimapper;
using sim::SignStyle;

sim::WorldOptions shortLoop() {
  sim::WorldOptions options;
  options.generator = "loop";
  options.length = 30;
  return options;
}

sim::World make(const sim::WorldOptions& options) {
  return sim::makeWorld(sim::generate(options, "test"));
}

int countBodies(const sim::World& world, const std::string& prefix) {
  return static_cast<int>(std::count_if(world.bodies.begin(), world.bodies.end(),
                                        [&](const sim::Body& body) { return body.name.rfind(prefix, 0) == 0; }));
}

TEST(BuildingSigns, repeatedSignsAreAsManyAndSpreadOverThreeWords) {
  sim::WorldOptions options = shortLoop();
  const sim::World before = make(options);
  options.repeated_signs = 7;
  const sim::World world = make(options);
  ASSERT_EQ(world.signs.size(), before.signs.size());
  std::map<std::string, int> times;
  for (std::size_t i = 0; i < world.signs.size(); ++i) {
    const sim::Sign& sign = world.signs[i];
    EXPECT_TRUE(sign.map_from_sign.translation.head<2>().isApprox(before.signs[i].map_from_sign.translation.head<2>()))
        << "where signs hang depends on nothing they say";
    if (sign.lines == before.signs[i].lines) continue;
    ASSERT_EQ(sign.lines.size(), 1u);
    ++times[sign.lines[0]];
  }
  EXPECT_EQ(times, (std::map<std::string, int>{{"Storage", 3}, {"Women", 2}, {"Men", 2}}));
}

TEST(BuildingSigns, moreRepeatedSignsThanDoorsAreAllDoors) {
  sim::WorldOptions options = shortLoop();
  options.repeated_signs = 1000;
  std::set<std::string> titles;
  for (const sim::Sign& sign : make(options).signs) titles.insert(sign.lines[0]);
  EXPECT_EQ(titles, (std::set<std::string>{"Storage", "Women", "Men"}));
}

// There are four corridors, clockwise; each ends at the outer wall of the next one, at its corner.
TEST(BuildingSigns, anExitSignHangsWhereEachCorridorLeadsTo) {
  sim::WorldOptions options;
  options.generator = "laboratory";
  options.exit_signs = true;
  const sim::World world = make(options);
  std::vector<Eigen::Vector2d> exits;
  for (const sim::Sign& sign : world.signs) {
    if (sign.lines != std::vector<std::string>{"EXIT"}) continue;
    EXPECT_NEAR(sign.map_from_sign.translation.z(), sim::usualHeight(SignStyle::exit), 1e-9);
    exits.push_back(sign.map_from_sign.translation.head<2>());
  }
  // West hall up to y = 11.62, north hall to the right up to x = 15.62, east hall down to y = 0.
  const double before = sim::kSignThickness;
  ASSERT_EQ(exits.size(), 3u);
  EXPECT_TRUE(exits[0].isApprox(Eigen::Vector2d(-0.87, 11.62 - before)));
  EXPECT_TRUE(exits[1].isApprox(Eigen::Vector2d(15.62 - before, 10.87)));
  EXPECT_TRUE(exits[2].isApprox(Eigen::Vector2d(14.87, before)));
}

TEST(BuildingSigns, announcementsHangInCorridors) {
  sim::WorldOptions options = shortLoop();
  EXPECT_EQ(countBodies(make(options), "announcement_"), 0);
  options.announcements = 3;
  const sim::World world = make(options);
  EXPECT_EQ(countBodies(world, "announcement_"), 3);
  EXPECT_TRUE(std::none_of(world.signs.begin(), world.signs.end(), [](const sim::Sign& sign) {
    return sign.name.rfind("announcement", 0) == 0;
  })) << "a poster is no sign";
}

TEST(BuildingSigns, theOtherStyleHangsHigherAndHasOtherPlates) {
  sim::WorldOptions options = shortLoop();
  const sim::World dark = make(options);
  options.sign_style = "white";
  const sim::World white = make(options);
  ASSERT_EQ(dark.signs.size(), white.signs.size());
  for (std::size_t i = 0; i < dark.signs.size(); ++i) {
    EXPECT_NEAR(dark.signs[i].map_from_sign.translation.z(), 1.5, 1e-9);
    EXPECT_NEAR(white.signs[i].map_from_sign.translation.z(), 1.62, 1e-9);
    EXPECT_EQ(dark.signs[i].lines, white.signs[i].lines);
    EXPECT_GT(white.signs[i].width, dark.signs[i].width);
  }
}

TEST(BuildingSigns, wallsOfCorridorsAreOfTheMaterialAskedFor) {
  sim::WorldOptions options = shortLoop();
  options.hall_wall = "brick";
  const auto plan = sim::generate(options, "test");
  for (const sim::RoomPlan& room : plan.rooms) {
    EXPECT_EQ(room.wall == "brick", room.kind == "corridor") << room.name;
  }
  options.hall_wall = "bric";
  try {
    sim::generate(options, "test.ini");
    FAIL() << "a material that is not there";
  } catch (const base::Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("test.ini: [world] hall_wall"), std::string::npos) << message;
    EXPECT_NE(message.find("brick"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace building_signs_test
