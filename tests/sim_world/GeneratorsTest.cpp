#include <gtest/gtest.h>
#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/PlanDrawing.h>
#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Scene.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ReachableRooms.h"

namespace generators_test {
namespace {

using namespace omnimapper;
using Eigen::Vector2d;
using Eigen::Vector3d;

sim::World makePlace(const std::string& generator, int seed, double length = 200,
                     sim::ClutterLevel clutter = sim::ClutterLevel::medium) {
  sim::WorldOptions options;
  options.generator = generator;
  options.seed = seed;
  options.length = length;
  options.clutter = clutter;
  return sim::makeWorld(sim::generate(options, "test"));
}

struct Place {
  const char* generator;
  double length;
};
const Place kPlaces[] = {{"home", 0},   {"office", 0}, {"laboratory", 0},      {"two_offices", 0}, {"loop", 30},
                         {"loop", 200}, {"loop", 400}, {"corridor_loop", 300}, {"box", 0},         {"road", 0}};

// Every triangle of a planar surface lies on its plane, and together they are its outline without its holes.
void expectExactPlanes(const sim::World& world) {
  for (const auto& body : world.bodies) {
    std::map<int, double> area;
    for (const auto& triangle : body.triangles) {
      const auto corner = [&](int i) -> const Vector3d& { return body.vertices_in_body[triangle.corners[i]]; };
      const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)) / 2;
      area[triangle.surface] += normal.norm();
      const auto& face = body.surfaces[triangle.surface].face;
      if (!face) continue;
      EXPECT_GE(normal.dot(face->plane_in_body.normal), 0) << body.surfaces[triangle.surface].name;
      for (int i = 0; i < 3; ++i)
        ASSERT_NEAR(geometry::signedDistance(face->plane_in_body, corner(i)), 0, 1e-9)
            << body.surfaces[triangle.surface].name;
    }
    for (std::size_t i = 0; i < body.surfaces.size(); ++i) {
      if (!body.surfaces[i].face) continue;
      ASSERT_NEAR(area[static_cast<int>(i)], sim::areaOf(*body.surfaces[i].face), 1e-9) << body.surfaces[i].name;
    }
  }
}

TEST(Generators, planesAreExactInEveryPlace) {
  for (const Place& place : kPlaces) {
    const int seeds = place.length == 0 ? 2 : 1;  // a loop has hundreds of signs, which take time to draw
    for (int seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(std::string(place.generator) + " " + std::to_string(seed));
      expectExactPlanes(makePlace(place.generator, seed, place.length));
    }
  }
}

TEST(Generators, noRayEscapesFromRoomsButThroughWindows) {
  for (const Place& place : kPlaces) {
    if (std::string(place.generator) == "road" || place.length >= 300) continue;
    const sim::World world = makePlace(place.generator, 3, place.length);
    const sim::Scenes scenes(world);
    const sim::Scene scene = scenes.at(0);
    sim::Random random(7, {1});
    for (const sim::Room& room : world.rooms) {
      Vector2d low = room.outline[0], high = low;
      for (const Vector2d& p : room.outline) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      for (int i = 0; i < 200; ++i) {
        const Vector2d at(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()));
        if (!sim::contains(room.outline, at)) continue;
        const Vector3d from(at.x(), at.y(), room.floorAt(at) + random.uniform(0.05, room.height - 0.05));
        const Vector3d to = Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
        ASSERT_TRUE(scene.cast({from, to}).isHit()) << room.name << " " << from.transpose() << " to " << to.transpose();
      }
    }
  }
}

TEST(Generators, oneSeedIsOneWorldAndAnotherSeedAnother) {
  const auto same = [](const sim::World& a, const sim::World& b) {
    if (a.bodies.size() != b.bodies.size()) return false;
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      const auto &x = a.bodies[i], &y = b.bodies[i];
      if (x.name != y.name || x.vertices_in_body != y.vertices_in_body) return false;
      const auto &first = x.track.places(), &second = y.track.places();
      if (first.size() != second.size()) return false;
      for (std::size_t k = 0; k < first.size(); ++k) {
        if (first[k].map_from_body->translation != second[k].map_from_body->translation) return false;
      }
    }
    return true;
  };
  for (const char* generator : {"home", "two_offices", "road"}) {
    const sim::World once = makePlace(generator, 5);
    EXPECT_TRUE(same(once, makePlace(generator, 5))) << generator;
    EXPECT_FALSE(same(once, makePlace(generator, 6))) << generator;
  }
}

TEST(Generators, aRobotComesToEveryRoomAtAllLevelsOfClutter) {
  for (const char* generator : {"home", "office", "laboratory", "two_offices"}) {
    for (const auto level : {sim::ClutterLevel::low, sim::ClutterLevel::medium, sim::ClutterLevel::high}) {
      for (int seed = 1; seed <= (std::string(generator) == "home" ? 4 : 1); ++seed) {
        const auto missing = reachable_rooms::unreachableRooms(makePlace(generator, seed, 200, level));
        EXPECT_TRUE(missing.empty()) << generator << " seed " << seed << " level " << static_cast<int>(level) << ": "
                                     << missing.front();
      }
    }
  }
}

TEST(Generators, loopsAreClosedAndAsLongAsAsked) {
  for (const double length : {30.0, 200.0, 400.0}) {
    const sim::World world = makePlace("loop", 1, length);
    EXPECT_TRUE(reachable_rooms::unreachableRooms(world).empty());
    Vector2d low(1e9, 1e9), high = -low;
    double width = 0;
    for (const sim::Room& room : world.rooms) {
      if (room.kind != "corridor") continue;
      for (const Vector2d& p : room.outline) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      if (room.name == "west_hall") width = room.outline[1].x() - room.outline[0].x();
    }
    const Vector2d middle = high - low - Vector2d(width, width);
    EXPECT_NEAR(2 * (middle.x() + middle.y()), length, 1e-9);
    EXPECT_GE(world.signs.size(), length / 20);
  }
}

TEST(Generators, twoOfficesAreThoseOfTheThesis) {
  const sim::World world = makePlace("two_offices", 1);
  EXPECT_EQ(world.markers.size(), 12u + 9 + 8 + 10);
  EXPECT_EQ(world.point_landmarks.size(), world.markers.size());
  int moved = 0;
  for (const auto& body : world.bodies) {
    const bool is_marker = body.surfaces.front().kind == sim::SurfaceKind::marker;
    if (!is_marker || body.track.isFixed()) continue;
    ++moved;
    EXPECT_LT(body.track.at(0)->translation.x(), 4.5);
    EXPECT_GT(body.track.at(1000)->translation.x(), 13.5);
  }
  EXPECT_EQ(moved, 10);
}

TEST(Generators, theBoxIsThatOfTheThesis) {
  const sim::World world = makePlace("box", 1);
  ASSERT_EQ(world.rooms.size(), 1u);
  EXPECT_NEAR(sim::doubleArea(world.rooms[0].outline) / 2, 42, 1e-12);
  EXPECT_EQ(world.point_landmarks.size(), 2u * 6 + 2 * 7 + 8);
  EXPECT_EQ(world.obstacles.size(), 4u);
}

TEST(Generators, homesHaveObjectsThatAreElsewhereLater) {
  const sim::World world = makePlace("home", 1);
  int moved = 0;
  for (const auto& object : world.objects) {
    for (const auto& body : world.bodies) moved += body.name == object.name && !body.track.isFixed();
  }
  EXPECT_GE(world.objects.size(), 12u);
  EXPECT_GE(moved, 3);
}

TEST(Generators, plansAreDrawnWithTheirRooms) {
  const std::string svg = sim::drawPlan(makePlace("home", 1));
  EXPECT_NE(svg.find("living room"), std::string::npos);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

}  // namespace
}  // namespace generators_test
