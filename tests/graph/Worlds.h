#pragma once

#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/graph/VariableKinds.h>

#include <random>
#include <vector>

namespace omnimapper::graph {

using geometry::Se2;
using geometry::Se3;

/// Seeded draws of zero mean.
class Noise {
 public:
  explicit Noise(unsigned seed) : rng_(seed) {}
  double normal(double sigma) { return sigma * normal_(rng_); }
  double uniform(double size) { return std::uniform_real_distribution<double>(-size, size)(rng_); }
  Eigen::VectorXd normals(const Eigen::VectorXd& sigmas) {
    Eigen::VectorXd draws = sigmas;
    for (double& draw : draws) draw = normal(draw);
    return draws;
  }
  Eigen::Vector3d vector(double size) { return {uniform(size), uniform(size), uniform(size)}; }
  Se2 se2() { return {uniform(5), uniform(5), uniform(3)}; }
  Se3 se3() { return {geometry::expSo3(vector(1.7)), vector(5)}; }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(rng_); }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/// A graph whose truth is known. Its values are the truth; the first pose is fixed.
template <class Pose>
struct World {
  Graph graph;
  std::vector<base::VariableId> ids;
  std::vector<Pose> truth;
};

using World2 = World<Se2>;
using World3 = World<Se3>;

/// A robot in the streets of a square town: steps of 1 m, quarter turns at random, an edge to wherever it was before
/// within a step, all edges with noise of the given sigmas (x y yaw).
inline World2 gridWorld(int poses, unsigned seed, const Eigen::Vector3d& sigmas) {
  World2 world;
  Noise noise(seed);
  const int size = 12;
  int x = 0, y = 0, heading = 0;
  for (int i = 0; i < poses; ++i) {
    world.truth.push_back({double(x), double(y), geometry::wrapToPi(heading * geometry::kPi / 2)});
    world.ids.push_back(world.graph.addVariable(se2(), toValue(world.truth.back()), i == 0));
    const int turn = noise.below(5);
    if (turn < 2) heading = (heading + (turn == 0 ? 1 : 3)) % 4;
    const int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
    while (std::abs(x + dx[heading]) > size || std::abs(y + dy[heading]) > size) heading = (heading + 1) % 4;
    x += dx[heading];
    y += dy[heading];
  }
  const auto add = [&](int a, int b) {
    const Se2 measured = plus(inverse(world.truth[a]) * world.truth[b], noise.normals(sigmas));
    world.graph.addFactor({{world.ids[a], world.ids[b]},
                           std::make_shared<BetweenSe2>(measured),
                           SquareRootInformation::fromSigmas(sigmas)});
  };
  for (int b = 1; b < poses; ++b) {
    add(b - 1, b);
    int links = 0;
    for (int a = 0; a < b - 10 && links < 2; ++a)
      if ((world.truth[a].translation() - world.truth[b].translation()).norm() < 0.5) {
        add(a, b);
        ++links;
      }
  }
  return world;
}

/// A robot on rings around a ball of 10 m, from pole to pole, an edge to the next pose and to the neighbour on the ring
/// before, all with noise of the given sigmas (translation, rotation).
inline World3 sphereWorld(int rings, int poses_per_ring, unsigned seed, double sigma_m, double sigma_rad) {
  World3 world;
  Noise noise(seed);
  geometry::Vector6d sigmas;
  sigmas << Eigen::Vector3d::Constant(sigma_m), Eigen::Vector3d::Constant(sigma_rad);
  const int count = rings * poses_per_ring;
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2 * geometry::kPi * i / poses_per_ring;
    const double height = geometry::kPi * (double(i) / count - 0.5) * 0.9;
    const Eigen::Quaterniond turn = Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(-height, Eigen::Vector3d::UnitY()) *
                                    Eigen::Quaterniond(1, 0, 0, 0);
    world.truth.push_back({turn, turn * Eigen::Vector3d(10, 0, 0)});
    world.ids.push_back(world.graph.addVariable(se3(), toValue(world.truth.back()), i == 0));
  }
  const auto add = [&](int a, int b) {
    const Se3 measured = plus(inverse(world.truth[a]) * world.truth[b], geometry::Vector6d(noise.normals(sigmas)));
    world.graph.addFactor({{world.ids[a], world.ids[b]},
                           std::make_shared<BetweenSe3>(measured),
                           SquareRootInformation::fromSigmas(sigmas)});
  };
  for (int b = 1; b < count; ++b) {
    add(b - 1, b);
    if (b >= poses_per_ring) add(b - poses_per_ring, b);
  }
  return world;
}

/// A smaller graph of the sphere, for tests that go through everything.
inline World3 smallWorld(unsigned seed) {
  return sphereWorld(4, 6, seed, 0.05, 0.02);
}

template <class Pose>
Pose poseOf(const Graph& graph, base::VariableId id) {
  if constexpr (std::is_same_v<Pose, Se2>)
    return se2FromValue(graph.value(id).data());
  else
    return se3FromValue(graph.value(id).data());
}

}  // namespace omnimapper::graph
