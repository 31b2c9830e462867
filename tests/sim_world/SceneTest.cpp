#include <gtest/gtest.h>
#include <omnimapper/sim_world/Scene.h>

#include <thread>

namespace scene_test {
namespace {

using namespace omnimapper;
using sim::Body;
using sim::Hit;
using sim::Ray;

// A square of 2 m in the body's y-z plane, facing -x.
Body square(const std::string& name, sim::Track track) {
  Body body;
  body.name = name;
  body.vertices_in_body = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  body.surfaces.push_back({name, sim::SurfaceKind::wall, {}, {}});
  body.triangles.push_back({{0, 3, 2}, 0, {Eigen::Vector2f(0, 0), Eigen::Vector2f(0, 1), Eigen::Vector2f(1, 1)}});
  body.triangles.push_back({{0, 2, 1}, 0, {Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 1), Eigen::Vector2f(1, 0)}});
  body.track = std::move(track);
  return body;
}

geometry::Se3 at(double x, double y = 0, double z = 0) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

TEST(Scene, aHitIsTheNearestAndExact) {
  sim::World world;
  world.bodies.push_back(square("far", sim::Track(at(3))));
  world.bodies.push_back(square("near", sim::Track(at(2.0 / 3.0))));
  const sim::Scenes scenes(world);
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 0.3, -0.2).normalized();
  const Hit hit = scenes.at(0).cast({{0, 0, 0}, direction});
  ASSERT_TRUE(hit.isHit());
  EXPECT_EQ(hit.surface, 1);
  EXPECT_NEAR(hit.range, (2.0 / 3.0) / direction.x(), 1e-15);
  EXPECT_TRUE(hit.normal_in_map.isApprox(Eigen::Vector3d(-1, 0, 0)));
  // The hit is at y = 0.2 and z = -2/15 on the square, whose y and z are in [-1, 1].
  EXPECT_NEAR(hit.texture_at.x(), 0.6, 1e-5);
  EXPECT_NEAR(hit.texture_at.y(), 0.5 - 1.0 / 15, 1e-5);
}

TEST(Scene, bothSidesAreSeenAndNearAndFarBound) {
  sim::World world;
  world.bodies.push_back(square("a", sim::Track(at(1))));
  const sim::Scenes scenes(world);
  const sim::Scene scene = scenes.at(0);
  const Hit behind = scene.cast({{2, 0, 0}, {-1, 0, 0}});
  ASSERT_TRUE(behind.isHit());
  EXPECT_TRUE(behind.normal_in_map.isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_FALSE(scene.cast({{0, 0, 0}, {1, 0, 0}, 1.1}).isHit());
  EXPECT_FALSE(scene.cast({{0, 0, 0}, {1, 0, 0}, 0, 0.9}).isHit());
  EXPECT_FALSE(scene.cast({{0, 5, 0}, {1, 0, 0}}).isHit());
}

TEST(Scene, thingsAreWhereTheirTracksPutThem) {
  sim::World world;
  world.bodies.push_back(square("wall", sim::Track(at(9))));
  world.bodies.push_back(square("carried", sim::Track(sim::Track::Kind::steps, {{0, at(1)}, {10, at(2)}, {20, {}}})));
  world.bodies.push_back(square("walker", sim::Track(sim::Track::Kind::motion, {{0, at(5, -9)}, {30, at(5, 21)}})));
  const sim::Scenes scenes(world);
  const auto ahead = [&](double time) { return scenes.at(time).cast({{0, 0, 0}, {1, 0, 0}}).range; };
  EXPECT_DOUBLE_EQ(ahead(5), 1);
  EXPECT_DOUBLE_EQ(ahead(9.999), 1);
  EXPECT_DOUBLE_EQ(ahead(10), 2);
  EXPECT_DOUBLE_EQ(ahead(20), 9);
  EXPECT_DOUBLE_EQ(ahead(0), 1);
  const auto aside = [&](double time) { return scenes.at(time).cast({{4, 0, 0}, {1, 0, 0}}).range; };
  EXPECT_DOUBLE_EQ(aside(7.9), 5);
  EXPECT_DOUBLE_EQ(aside(8.1), 1);
  EXPECT_DOUBLE_EQ(aside(10.1), 5);
}

TEST(Scene, ListsOfRaysAnswerAsSingleRaysDo) {
  sim::World world;
  for (int i = 0; i < 20; ++i)
    world.bodies.push_back(square("s" + std::to_string(i), sim::Track(at(1 + 0.3 * i, 0.2 * i))));
  const sim::Scenes scenes(world);
  const sim::Scene scene = scenes.at(0);
  std::vector<Ray> rays;
  for (int i = 0; i < 101; ++i) {
    const double angle = -1.5 + 0.03 * i;
    rays.push_back({{0, 0, 0.1}, {std::cos(angle), std::sin(angle), 0}});
  }
  std::vector<Hit> hits;
  scene.cast(rays, hits);
  std::vector<char> blocked;
  scene.findBlocked(rays, blocked);
  int hit_count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit alone = scene.cast(rays[i]);
    EXPECT_EQ(alone.surface, hits[i].surface) << i;
    EXPECT_EQ(alone.range, hits[i].range) << i;
    EXPECT_EQ(blocked[i] != 0, hits[i].isHit()) << i;
    hit_count += hits[i].isHit();
  }
  EXPECT_GT(hit_count, 30);
  EXPECT_LT(hit_count, 100);
}

TEST(Scene, threadsMayAskAtOnce) {
  sim::World world;
  world.bodies.push_back(square("carried", sim::Track(sim::Track::Kind::steps, {{0, at(1)}, {1, at(2)}, {2, at(3)}})));
  world.bodies.push_back(square("walker", sim::Track(sim::Track::Kind::motion, {{0, at(0.5, 5)}, {3, at(0.5, 8)}})));
  const sim::Scenes scenes(world);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 300; ++i) {
        const double time = (i * 7 + t) % 30 / 10.0;
        wrong[t] += scenes.at(time).cast({{0, 0, 0}, {1, 0, 0}}).range != 1 + std::floor(time);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace scene_test
