// The flat surfaces that the triangles of bodies form, and the openings of buildings.
#include <gtest/gtest.h>
#include <omnimapper/sim_world/Furniture.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/Patches.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <map>
#include <set>

namespace patches_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;
using surfaces::Opening;
using surfaces::SurfaceClass;

sim::Body bodyOf(const std::string& shape) {
  const sim::FurnitureShape& of = *sim::findFurnitureShape(shape);
  sim::FurniturePlan plan;
  plan.name = plan.shape = shape;
  return sim::makeFurniture(sim::withUsualSize(plan, of), of, sim::Track(geometry::Se3{}), sim::Random(1, {}));
}

std::vector<sim::Patch> patchesOf(sim::Body body) {
  sim::World world;
  world.bodies.push_back(std::move(body));
  return sim::findPatches(world);
}

double areaOf(const sim::Patch& patch) {
  surfaces::Surface surface;
  surface.parts = {patch.part_in_body};
  return surfaces::areaOf(surface);
}

SurfaceClass classOf(const sim::World& world, const sim::Patch& patch) {
  const sim::SurfaceRef ref = sim::numberSurfaces(world).at(static_cast<std::size_t>(patch.surface));
  return world.bodies[static_cast<std::size_t>(ref.body)].surfaces[static_cast<std::size_t>(ref.surface)].is;
}

sim::World twoRooms() {
  sim::WorldPlan plan;
  sim::RoomPlan hall, kitchen;
  hall.name = "hall";
  hall.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  kitchen.name = "kitchen";
  kitchen.outline = {{4.2, 0}, {7, 0}, {7, 3}, {4.2, 3}};
  plan.rooms = {hall, kitchen};
  sim::OpeningPlan door, window;
  door.name = "door";
  door.rooms = {"hall", "kitchen"};
  door.x = 4;
  door.y = 1.5;
  door.leaf_angle = 1.2;
  window.name = "window";
  window.kind = sim::OpeningPlan::Kind::window;
  window.rooms = {"hall", "outside"};
  window.x = 2;
  window.y = 3;
  window.sill = 0.9;
  window.height = 1.2;
  window.width = 1;
  plan.openings = {door, window};
  return sim::makeWorld(plan);
}

TEST(Patches, ABoxHasSixWithNormalsOutOfIt) {
  sim::MeshBuilder builder("box");
  builder.addBox(builder.addSurface("", sim::SurfaceKind::clutter, {}), {1, 2, 3}, {2, 4, 6});
  const auto patches = patchesOf(builder.build());
  ASSERT_EQ(patches.size(), 6u);
  std::multiset<double> areas;
  for (const sim::Patch& patch : patches) {
    areas.insert(std::round(areaOf(patch) * 1e9) / 1e9);
    EXPECT_EQ(patch.part_in_body.outline.size(), 4u);
    EXPECT_TRUE(patch.part_in_body.holes.empty());
    // The middle of the box lies half its size behind each plane.
    const Vector3d& n = patch.plane_in_body.normal;
    const double half = (n.cwiseAbs().dot(Vector3d(1, 2, 3))) / 2;
    EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1, 1e-12);
    EXPECT_NEAR(geometry::signedDistance(patch.plane_in_body, {1.5, 3, 4.5}), -half, 1e-12);
    for (const Vector3d& corner : patch.part_in_body.outline)
      EXPECT_NEAR(geometry::signedDistance(patch.plane_in_body, corner), 0, 1e-12);
  }
  EXPECT_EQ(areas, (std::multiset<double>{2, 2, 3, 3, 6, 6}));
}

TEST(Patches, AnAngledFaceWithAHoleIsOnePatchWithOneHole) {
  // An L of 4 x 3 less 2 x 2 m, with a hole of 0.5 x 0.5 m.
  sim::MeshBuilder builder("wall");
  const int surface = builder.addSurface("", sim::SurfaceKind::wall, {});
  builder.addFace(surface, {{0, 0, 0}, {4, 0, 0}, {4, 0, 1}, {2, 0, 1}, {2, 0, 3}, {0, 0, 3}},
                  {{{0.5, 0, 1.5}, {1, 0, 1.5}, {1, 0, 2}, {0.5, 0, 2}}});
  const auto patches = patchesOf(builder.build());
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_NEAR(areaOf(patches[0]), 8 - 0.25, 1e-12);
  EXPECT_EQ(patches[0].part_in_body.outline.size(), 6u);
  ASSERT_EQ(patches[0].part_in_body.holes.size(), 1u);
  EXPECT_EQ(patches[0].part_in_body.holes[0].size(), 4u);
  EXPECT_NEAR(patches[0].plane_in_body.normal.y(), -1, 1e-12);
}

TEST(Patches, FacesOfOneSurfaceThatShareAnEdgeAreOneAndThoseThatTouchInACornerAreTwo) {
  sim::MeshBuilder builder("tiles");
  const int surface = builder.addSurface("", sim::SurfaceKind::wall, {}),
            other = builder.addSurface("other", sim::SurfaceKind::wall, {});
  builder.addFace(surface, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.addFace(surface, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  builder.addFace(surface, {{2, 1, 0}, {3, 1, 0}, {3, 2, 0}, {2, 2, 0}});
  builder.addFace(other, {{2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}});
  std::map<std::string, double> areas;
  for (const sim::Patch& patch : patchesOf(builder.build())) areas[patch.name] = areaOf(patch);
  ASSERT_EQ(areas.size(), 3u);
  EXPECT_NEAR(areas["tiles#1"] + areas["tiles#2"], 3, 1e-12);
  EXPECT_NEAR(areas["tiles#1"] * areas["tiles#2"], 2, 1e-12);
  EXPECT_NEAR(areas["tiles/other"], 1, 1e-12);
}

TEST(Patches, RoundThingsHaveOnlyTheirFlatEnds) {
  sim::MeshBuilder builder("pillar");
  builder.addCylinder(builder.addSurface("", sim::SurfaceKind::wall, {}), 0.5, 0, 3, 16);
  const auto patches = patchesOf(builder.build());
  ASSERT_EQ(patches.size(), 2u);
  for (const auto& patch : patches) EXPECT_NEAR(std::abs(patch.plane_in_body.normal.z()), 1, 1e-12);
}

TEST(Patches, ATableHasOneTopAndTheRestIsCabinet) {
  sim::World world;
  world.bodies.push_back(bodyOf("table"));
  int tops = 0;
  for (const auto& patch : sim::findPatches(world)) {
    if (classOf(world, patch) != SurfaceClass::table) {
      EXPECT_EQ(classOf(world, patch), SurfaceClass::cabinet) << patch.name;
      continue;
    }
    ++tops;
    EXPECT_EQ(patch.name, "table/top");
    EXPECT_NEAR(areaOf(patch), 1.6 * 0.9, 1e-9);
    EXPECT_NEAR(patch.plane_in_body.distance, -0.74, 1e-12);
  }
  EXPECT_EQ(tops, 1);
}

TEST(Patches, EachPieceOfFurnitureHasTheClassesThatPeopleNameItBy) {
  const auto classesOf = [](const std::string& shape) {
    std::set<SurfaceClass> classes;
    for (const auto& surface : bodyOf(shape).surfaces) classes.insert(surface.is);
    return classes;
  };
  using Class = SurfaceClass;
  using Classes = std::set<Class>;
  EXPECT_EQ(classesOf("sofa"), Classes{Class::seat});
  EXPECT_EQ(classesOf("fridge"), Classes{Class::appliance});
  EXPECT_EQ(classesOf("wardrobe"), Classes{Class::cabinet});
  EXPECT_EQ(classesOf("counter"), (Classes{Class::counter, Class::cabinet}));
  EXPECT_EQ(classesOf("bookcase"), (Classes{Class::shelf, Class::cabinet, Class::object}));
  EXPECT_EQ(classesOf("glass_pane"), Classes{Class::window});
  EXPECT_EQ(classesOf("house"), Classes{Class::wall});
  EXPECT_EQ(classesOf("plant"), Classes{Class::object});
}

TEST(Patches, RoomsAndOpeningsHaveTheirClasses) {
  std::map<std::string, SurfaceClass> classes;
  const sim::World world = twoRooms();
  for (const auto& patch : sim::findPatches(world)) classes[patch.name] = classOf(world, patch);
  EXPECT_EQ(classes.at("hall/floor"), SurfaceClass::floor);
  EXPECT_EQ(classes.at("kitchen/ceiling"), SurfaceClass::ceiling);
  EXPECT_EQ(classes.at("hall/wall_1"), SurfaceClass::wall);
  EXPECT_EQ(classes.at("door_leaf/front"), SurfaceClass::door);
  EXPECT_EQ(classes.at("door/frame#1"), SurfaceClass::door_frame);
  EXPECT_EQ(classes.at("door/threshold"), SurfaceClass::floor);
  EXPECT_EQ(classes.at("window/pane"), SurfaceClass::window);
  EXPECT_EQ(classes.at("window/sill"), SurfaceClass::window);
}

TEST(Patches, AFloorIsARampFromTwoDegreesOn) {
  for (const double degrees : {0.0, 1.9, 2.1}) {
    sim::WorldPlan plan;
    sim::RoomPlan room;
    room.name = "room";
    room.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    room.slope_x = std::tan(degrees * M_PI / 180);
    plan.rooms = {room};
    EXPECT_EQ(sim::makeWorld(plan).bodies[0].surfaces[0].is, degrees > 2 ? SurfaceClass::ramp : SurfaceClass::floor);
  }
}

TEST(Patches, OpeningsAreRectanglesOnTheWallOfTheirFirstRoom) {
  const sim::World world = twoRooms();
  ASSERT_EQ(world.openings.size(), 2u);
  const Opening &door = world.openings[0], &window = world.openings[1];
  EXPECT_EQ(door.kind, Opening::Kind::door);
  EXPECT_EQ(door.rooms, (std::array<std::string, 2>{"hall", "kitchen"}));
  EXPECT_EQ(door.leaf, Opening::Leaf::open);
  EXPECT_EQ(door.leaf_angle, 1.2);
  EXPECT_EQ(door.leaf_body, "door_leaf");
  // Looking along x, greater y is to the left.
  const std::array<Vector3d, 4> of_door{{{4, 1.95, 0}, {4, 1.05, 0}, {4, 1.05, 2.05}, {4, 1.95, 2.05}}};
  // Looking along y, smaller x is to the left.
  const std::array<Vector3d, 4> of_window{{{1.5, 3, 0.9}, {2.5, 3, 0.9}, {2.5, 3, 2.1}, {1.5, 3, 2.1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((door.rectangle[i] - of_door[i]).norm(), 1e-9) << i << ": " << door.rectangle[i].transpose();
    EXPECT_LT((window.rectangle[i] - of_window[i]).norm(), 1e-9) << i << ": " << window.rectangle[i].transpose();
  }
  EXPECT_EQ(window.kind, Opening::Kind::window);
  EXPECT_EQ(window.leaf, Opening::Leaf::none);
  EXPECT_EQ(window.rooms[1], "outside");
}

TEST(Patches, EveryRoomOfTheHomeHasFloorCeilingAndWallsAndEveryDoorIsAnOpening) {
  sim::WorldOptions options;
  options.generator = "home";
  const sim::WorldPlan plan = sim::generate(options, "test");
  const sim::World world = sim::makeWorld(plan);
  std::map<std::string, std::map<SurfaceClass, int>> count;
  std::set<std::string> names;
  for (const auto& patch : sim::findPatches(world)) {
    ++count[world.bodies[static_cast<std::size_t>(patch.body)].name][classOf(world, patch)];
    EXPECT_TRUE(names.insert(patch.name).second) << patch.name;
    EXPECT_GT(areaOf(patch), 0.05 - 1e-9) << patch.name;
  }
  for (const sim::Room& room : world.rooms) {
    EXPECT_EQ(count[room.name][SurfaceClass::floor], 1) << room.name;
    EXPECT_EQ(count[room.name][SurfaceClass::ceiling], 1) << room.name;
    EXPECT_GE(count[room.name][SurfaceClass::wall], 2) << room.name;
  }
  ASSERT_EQ(world.openings.size(), plan.openings.size());
  for (std::size_t i = 0; i < plan.openings.size(); ++i) {
    const Opening& opening = world.openings[i];
    EXPECT_EQ(opening.name, plan.openings[i].name);
    EXPECT_EQ(opening.rooms[0], plan.openings[i].rooms[0]);
    EXPECT_EQ(opening.rooms[1], plan.openings[i].rooms[1]);
    const Vector3d middle = (opening.rectangle[0] + opening.rectangle[2]) / 2;
    EXPECT_LT((middle.head<2>() - Eigen::Vector2d(plan.openings[i].x, plan.openings[i].y)).norm(), 1.0);
    EXPECT_NEAR(opening.rectangle[3].z() - opening.rectangle[0].z(), plan.openings[i].height, 1e-6) << opening.name;
    if (opening.leaf == Opening::Leaf::none) continue;
    EXPECT_GT(count[opening.leaf_body][SurfaceClass::door], 0) << opening.name;
  }
}

}  // namespace
}  // namespace patches_test
