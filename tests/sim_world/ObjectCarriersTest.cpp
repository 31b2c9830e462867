// Objects that stand on one another, touch one another, and go with what carries them.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/sim_world/ObjectMaking.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <cmath>

namespace object_carriers_test {
namespace {

using namespace omnimapper;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTable = 0.74;  // height of the table [m]

// A room with a table of 1.6 x 0.9 m about (2, 2) and a shelf with boards every 0.43 m.
std::string room(const std::string& objects, const std::string& sections) {
  return "[world]\nrooms = room\nfurniture = table shelf\nobjects = " + objects +
         "\n[room]\nclass = room\nrectangle_m = 0 0 6 4\n"
         "[table]\nclass = table\nx_m = 2\ny_m = 2\n[shelf]\nclass = shelf\nx_m = 4.5\ny_m = 3.8\n" +
         sections;
}

std::string section(const std::string& name, const std::string& shape, double x, double y, const std::string& keys) {
  return "[" + name + "]\nclass = " + shape + "\nx_m = " + std::to_string(x) + "\ny_m = " + std::to_string(y) + "\n" +
         keys + "\n";
}

std::string size(double length, double width, double height) {
  return "\nlength_m = " + std::to_string(length) + "\nwidth_m = " + std::to_string(width) +
         "\nheight_m = " + std::to_string(height);
}

sim::World read(const std::string& objects, const std::string& sections) {
  return sim::readWorld(base::Config::fromText(room(objects, sections), "w.ini"));
}

const sim::Body& bodyOf(const sim::World& world, const std::string& name) {
  for (const auto& body : world.bodies) {
    if (body.name == name) return body;
  }
  throw std::runtime_error("no body " + name);
}

Vector3d placeOf(const sim::World& world, const std::string& name, double time = 0) {
  return bodyOf(world, name).track.at(time)->translation;
}

std::vector<Vector2d> outlineInMap(const sim::World& world, const std::string& name) {
  const sim::Body& body = bodyOf(world, name);
  std::vector<Vector2d> points;
  for (const Vector3d& p : body.vertices_in_body) points.push_back((*body.track.at(0) * p).head<2>());
  return geometry::convexHull(std::move(points));
}

TEST(ObjectCarriers, objectsStandOnOneAnotherInWhateverOrderTheSectionsAre) {
  const std::string sections = section("low", "box", 2, 2, "on = table/top" + size(0.3, 0.2, 0.1)) +
                               section("high", "book", 2.02, 2, "on = low/top" + size(0.2, 0.15, 0.03)) +
                               section("cup", "cup", 2.02, 2.01, "on = high/top");
  for (const std::string order : {"low high cup", "cup high low", "high cup low"}) {
    const sim::World world = read(order, sections);
    EXPECT_TRUE(placeOf(world, "low").isApprox(Vector3d(2, 2, kTable))) << order;
    EXPECT_TRUE(placeOf(world, "high").isApprox(Vector3d(2.02, 2, kTable + 0.1))) << order;
    EXPECT_TRUE(placeOf(world, "cup").isApprox(Vector3d(2.02, 2.01, kTable + 0.13))) << order;
    EXPECT_EQ(world.objects[0].name, order.substr(0, order.find(' '))) << "the order of the INI";
  }
}

TEST(ObjectCarriers, objectsSayWhatTheyStandOn) {
  const sim::World world = read("box cup", section("box", "box", 2, 2, "on = table/top\nmoves = 20 5 1 0 | 30 away") +
                                               section("cup", "can", 2, 2, "on = box/top" + size(0.04, 0.04, 0.1)));
  const auto& box = world.objects[0].stands;
  ASSERT_EQ(box.size(), 3u);
  EXPECT_EQ(box[0].on, "table/top");
  EXPECT_EQ(box[1].on, "room/floor");
  EXPECT_EQ(box[2].on, "");
  EXPECT_EQ(box[2].from, 30);
  ASSERT_EQ(world.objects[1].stands.size(), 1u);
  EXPECT_EQ(world.objects[1].stands[0].on, "box/top");
}

TEST(ObjectCarriers, everyShapeThatCarriesHasItsTopOnItsMesh) {
  EXPECT_EQ(sim::carryingShapes(), (std::vector<std::string>{"book", "box", "brick", "can", "plate", "prism"}));
  for (const std::string& shape : sim::carryingShapes()) {
    const auto made = sim::makeObject({"thing", shape, 3, {}, {}, false});
    ASSERT_TRUE(made.top) << shape;
    double above = 0;  // highest point over the middle of the top's outline, which is convex
    double nearest = 1;
    for (const Vector3d& p : made.body.vertices_in_body) {
      above = std::max(above, p.z());
      nearest = std::min(nearest, std::abs(p.z() - made.top->z));
    }
    EXPECT_LT(nearest, 1e-9) << shape << ": the top is at the height of a corner";
    if (shape != "plate") {
      EXPECT_NEAR(made.top->z, above, 1e-9) << shape;
    }
    for (const Vector2d& p : made.top->outline_in_body) {
      const Vector3d extents = sim::extentsOf(made.body);
      EXPECT_LE(std::abs(p.x()), extents.x() / 2 + 0.02) << shape;
      EXPECT_LE(std::abs(p.y()), extents.y() / 2 + 0.02) << shape;
    }
  }
  EXPECT_FALSE(sim::makeObject({"thing", "ball", 3, {}, {}, false}).top);
}

TEST(ObjectCarriers, whatStandsOnAnObjectGoesWithIt) {
  const sim::World world =
      read("box cup", section("box", "box", 2, 2, "on = table/top\nmoves = 20 5 1 90 | 40 away" + size(0.3, 0.3, 0.2)) +
                          section("cup", "can", 2.1, 2, "on = box/top\nmoves = 30 5 2 0" + size(0.06, 0.06, 0.1)));
  EXPECT_TRUE(placeOf(world, "cup", 19).isApprox(Vector3d(2.1, 2, kTable + 0.2)));
  // The box is turned by 90 deg, so the cup, 0.1 m along its x, is 0.1 m along the map's y.
  EXPECT_TRUE(placeOf(world, "cup", 20).isApprox(Vector3d(5, 1.1, 0.2), 1e-9));
  EXPECT_TRUE(placeOf(world, "cup", 30).isApprox(Vector3d(5, 2, 0), 1e-9)) << "its own move comes later";
  EXPECT_TRUE(placeOf(world, "cup", 50).isApprox(Vector3d(5, 2, 0), 1e-9)) << "and it stays when the box goes";
  const sim::World away =
      read("box cup", section("box", "box", 2, 2, "on = table/top\nmoves = 40 away" + size(0.3, 0.3, 0.2)) +
                          section("cup", "can", 2.1, 2, "on = box/top" + size(0.06, 0.06, 0.1)));
  EXPECT_FALSE(bodyOf(away, "cup").track.at(40));
}

TEST(ObjectCarriers, touchingBoxesShareASide) {
  const sim::World world =
      read("a b", section("a", "box", 2, 2, "on = table/top" + size(0.3, 0.2, 0.1)) +
                      section("b", "box", 2.5, 2, "on = table/top\ntouching = a" + size(0.1, 0.1, 0.1)));
  EXPECT_NEAR(placeOf(world, "b").x(), 2 + 0.15 + 0.05, 2e-6);
  EXPECT_NEAR(placeOf(world, "b").y(), 2, 1e-12);
}

TEST(ObjectCarriers, touchingObjectsOfAnyShapeAndTurnMeetWithoutOverlap) {
  for (const std::string& shape : sim::objectShapes()) {
    for (const double angle : {0.0, 0.7, 2.0, -2.5}) {
      const double x = 2 + 0.1 * std::cos(angle), y = 2 + 0.1 * std::sin(angle);
      const std::string turned = "on = table/top\ntouching = cup\nyaw_deg = 25" + size(0.12, 0.08, 0.1);
      const sim::World world = read("thing cup", section("cup", "cup", 2, 2, "on = table/top\nyaw_deg = 40") +
                                                     section("thing", shape, x, y, turned));
      const auto one = outlineInMap(world, "thing"), two = outlineInMap(world, "cup");
      EXPECT_LT(geometry::distance(one, two), 2e-6) << shape;
      const Vector2d apart = placeOf(world, "thing").head<2>() - placeOf(world, "cup").head<2>();
      EXPECT_NEAR(std::atan2(apart.y(), apart.x()), angle, 1e-4) << shape << ": on the side that the INI says";
      auto moved = one;
      for (Vector2d& p : moved) p += 1e-4 * apart.normalized();
      EXPECT_GT(geometry::distance(moved, two), 0) << shape << ": they only touch";
    }
  }
}

struct Mistake {
  const char* name;
  std::string objects, sections, place;
  std::vector<std::string> words;
};

TEST(ObjectCarriers, impossibleStacksAreRefusedWithPlaceAndRemedy) {
  const std::string box = section("box", "box", 2, 2, "on = table/top" + size(0.2, 0.2, 0.1));
  const std::vector<Mistake> mistakes{
      {"a circle of two",
       "a b",
       section("a", "box", 2, 2, "on = b/top") + section("b", "box", 2, 2, "on = a/top"),
       "[a] on",
       {"circle", "'a' -> 'b' -> 'a'", "furniture"}},
      {"a circle by moves",
       "a b",
       section("a", "box", 2, 2, "on = b/top") + section("b", "box", 2, 2, "on = table/top\nmoves = 9 2 2 0 a/top"),
       "[a] on",
       {"circle"}},
      {"on itself", "a", section("a", "box", 2, 2, "on = a/top"), "[a] on", {"'a' -> 'a'"}},
      {"touching itself", "a", section("a", "box", 2, 2, "on = table/top\ntouching = a"), "[a] on", {"touch"}},
      {"an unknown carrier",
       "box a",
       box + section("a", "cup", 2, 2, "on = boxx/top"),
       "[a] on",
       {"'boxx/top'", "did you mean 'box/top'", "objects of the classes"}},
      {"a round carrier",
       "a b",
       section("b", "ball", 2, 2, "on = table/top") + section("a", "cup", 2, 2, "on = b/top"),
       "[a] on",
       {"'b/top'", "book, box, brick, can, plate, prism"}},
      {"a move to an unknown carrier", "a", section("a", "cup", 2, 2, "moves = 9 2 2 0 b/top"), "[a] moves", {"b/top"}},
      {"too large for its carrier",
       "box a",
       box + section("a", "box", 2, 2, "on = box/top" + size(0.25, 0.1, 0.1)),
       "[a] x_m",
       {"rim of 'box/top'", "0.25 x 0.1 m", "0.2 x 0.2 m", "smaller"}},
      {"over the rim",
       "box a",
       box + section("a", "box", 2.1, 2, "on = box/top" + size(0.1, 0.1, 0.1)),
       "[a] x_m",
       {"rim of 'box/top'"}},
      {"two in one place on a box",
       "box a b",
       box + section("a", "can", 2, 2, "on = box/top") + section("b", "can", 2.03, 2, "on = box/top"),
       "[b] x_m",
       {"stands in 'a'"}},
      {"a shade in the neighbouring stack",
       "box a b c",
       box + section("a", "box", 2, 2, "on = box/top" + size(0.2, 0.2, 0.3)) +
           section("b", "box", 2.22, 2, "on = table/top" + size(0.2, 0.2, 0.1)) +
           section("c", "lamp", 2.2, 2, "on = b/top" + size(0.24, 0.24, 0.3)),
       "[c] x_m",
       {"stands in 'a'"}},
      {"through the board above",
       "a",
       section("a", "box", 4.5, 3.8, "on = shelf/board_2" + size(0.1, 0.1, 0.5)),
       "[a] x_m",
       {"does not fit on 'shelf/board_2'", "'shelf'", "lower"}},
      {"a stack through the board above",
       "a b",
       section("a", "box", 4.5, 3.8, "on = shelf/board_2" + size(0.1, 0.1, 0.3)) +
           section("b", "box", 4.5, 3.8, "on = a/top" + size(0.08, 0.08, 0.2)),
       "[b] x_m",
       {"does not fit on 'a/top'", "'shelf'"}},
      {"on a carrier that is away",
       "box a",
       section("box", "box", 2, 2, "on = table/top\nmoves = 5 away") +
           section("a", "can", 5, 1, "moves = 9 2 2 0 box/top"),
       "[a] moves",
       {"'box' is away at 9 s"}},
      {"touching what stands elsewhere",
       "box a",
       box + section("a", "cup", 5, 1, "touching = box"),
       "[a] touching",
       {"'box'", "same surface"}},
      {"touching nothing", "a", section("a", "cup", 5, 1, "touching = vase"), "[a] touching", {"'vase'"}},
      {"touching in no direction",
       "box a",
       box + section("a", "cup", 2, 2, "on = table/top\ntouching = box"),
       "[a] x_m",
       {"side"}},
  };
  for (const Mistake& mistake : mistakes) {
    try {
      read(mistake.objects, mistake.sections);
      ADD_FAILURE() << mistake.name << " is accepted";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::out_of_range) << mistake.name;
      const std::string what = error.what();
      EXPECT_NE(what.find("w.ini: " + mistake.place), std::string::npos) << mistake.name << ": " << what;
      for (const std::string& word : mistake.words)
        EXPECT_NE(what.find(word), std::string::npos) << mistake.name << ": " << what;
    }
  }
}

TEST(ObjectCarriers, anObjectMayJutOutOverTheObjectThatCarriesIt) {
  // The saucer is flat out to 7 cm, and the cup reaches 7.3 cm with its handle.
  const sim::World world = read(
      "plate cup", section("plate", "plate", 2, 2, "on = table/top") + section("cup", "cup", 2, 2, "on = plate/top"));
  EXPECT_GT(placeOf(world, "cup").z(), kTable + 0.005);
  EXPECT_LT(placeOf(world, "cup").z(), kTable + 0.009);
}

}  // namespace
}  // namespace object_carriers_test
