// Crowded tables and shelves of generated places.
#include <gtest/gtest.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace object_clutter_test {
namespace {

using namespace omnimapper;

sim::WorldPlan planOf(const std::string& generator, int seed, sim::ObjectClutter clutter) {
  sim::WorldOptions options;
  options.generator = generator;
  options.seed = seed;
  options.object_clutter = clutter;
  return sim::generate(options, "test");
}

/// The space above an object's outline, seen from above, at time 0.
sim::Footprint spaceOf(const sim::Body& body) {
  sim::Footprint space{body.name, {}, 1e9, -1e9};
  for (const auto& vertex : body.vertices_in_body) {
    const Eigen::Vector3d in_map = *body.track.at(0) * vertex;
    space.outline_in_map.push_back(in_map.head<2>());
    space.low_z = std::min(space.low_z, in_map.z());
    space.high_z = std::max(space.high_z, in_map.z());
  }
  space.outline_in_map = geometry::convexHull(std::move(space.outline_in_map));
  return space;
}

TEST(ObjectClutter, addsObjectsAndChangesNothingElse) {
  for (const char* generator : {"home", "laboratory"}) {
    const auto bare = planOf(generator, 4, sim::ObjectClutter::none);
    std::size_t before = bare.objects.size();
    for (const auto clutter : {sim::ObjectClutter::low, sim::ObjectClutter::medium, sim::ObjectClutter::high}) {
      const auto crowded = planOf(generator, 4, clutter);
      EXPECT_GT(crowded.objects.size(), before + 5) << generator;
      before = crowded.objects.size();
      EXPECT_EQ(crowded.furniture.size(), bare.furniture.size());
      EXPECT_EQ(crowded.posters.size(), bare.posters.size());
      for (std::size_t i = 0; i < bare.objects.size(); ++i) {
        EXPECT_EQ(crowded.objects[i].name, bare.objects[i].name);
        EXPECT_EQ(crowded.objects[i].place.x, bare.objects[i].place.x);
        EXPECT_EQ(crowded.objects[i].moves.size(), bare.objects[i].moves.size());
      }
    }
  }
}

TEST(ObjectClutter, hasThinOnesTouchingOnesAndStacks) {
  const auto plan = planOf("laboratory", 4, sim::ObjectClutter::high);
  const auto count = [&](const auto& is) { return std::count_if(plan.objects.begin(), plan.objects.end(), is); };
  EXPECT_GT(count([](const sim::ObjectPlan& object) { return object.height > 0 && object.height <= 0.02; }), 0);
  EXPECT_GT(count([](const sim::ObjectPlan& object) { return !object.touching.empty(); }), 2);
  std::map<std::string, int> names;
  for (const auto& object : plan.objects) ++names[object.name + "/top"];
  EXPECT_GT(count([&](const sim::ObjectPlan& object) { return names.count(object.place.on) > 0; }), 2);
}

TEST(ObjectClutter, noTwoObjectsShareSpaceInManyPlaces) {
  for (const char* generator : {"home", "office", "laboratory"}) {
    for (int seed = 1; seed <= 4; ++seed) {
      const sim::World world = sim::makeWorld(planOf(generator, seed, sim::ObjectClutter::high));
      std::map<std::string, const sim::Object*> objects;
      for (const auto& object : world.objects) objects[object.name] = &object;
      std::vector<sim::Footprint> spaces;
      for (const auto& body : world.bodies) {
        if (objects.count(body.name) > 0) spaces.push_back(spaceOf(body));
      }
      const auto carries = [&](const std::string& below, const std::string& above) {
        return objects.at(above)->stands.front().on == below + "/top";
      };
      for (std::size_t i = 0; i < spaces.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          if (carries(spaces[i].name, spaces[j].name) || carries(spaces[j].name, spaces[i].name)) continue;
          EXPECT_FALSE(sim::overlap(spaces[i], spaces[j]))
              << generator << " " << seed << ": " << spaces[i].name << " and " << spaces[j].name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace object_clutter_test
