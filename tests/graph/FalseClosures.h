#pragma once

#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Consistency.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/VariableKinds.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <random>

namespace omnimapper::graph {

// Pose graphs for the consistency test: all edges but odometry are hypotheses, and some of these are false.

using base::FactorId;
using base::VariableId;
using geometry::Se2;

struct Edge {
  int a, b;
  Se2 a_from_b;
  SquareRootInformation noise;
  bool is_false = false;
};

/// A planar pose graph: trusted odometry, closures that are not trusted, and the true poses.
struct Problem {
  int poses = 0;
  std::vector<Edge> odometry, closures;
  std::vector<Se2> truth;
  bool has_truth = false;  // else the optimum is used
};

inline std::vector<Se2> valuesOf(const Graph& graph) {
  std::vector<Se2> poses;
  for (const auto& [id, record] : graph.variables()) poses.push_back(se2FromValue(record.value.data()));
  return poses;
}

/// Poses of the file in the order of their numbers; the truth is the optimum of the file's graph.
inline Problem fromG2o(const std::string& path) {
  G2oContent content = readG2o(path);
  Problem problem;
  std::map<VariableId, int> numbers;
  for (const auto& [number, id] : content.ids) numbers[id] = problem.poses++;
  for (const auto& [id, record] : content.graph.factors()) {
    const int a = numbers.at(record.variables[0]), b = numbers.at(record.variables[1]);
    const Edge edge{a, b, dynamic_cast<const BetweenSe2&>(*record.factor).measured(), record.noise};
    (b == a + 1 ? problem.odometry : problem.closures).push_back(edge);
  }
  solve(content.graph);
  problem.truth.resize(problem.poses);
  for (const auto& [id, number] : numbers) problem.truth[number] = se2FromValue(content.graph.value(id).data());
  return problem;
}

/// False closures in groups, `rate` times as many as the true ones. As in Vertigo, any two places are taken for the
/// same, within 0.3 m and 10 deg, and a group of k continues along both paths for k steps. Unlike Vertigo's, the group
/// follows the two paths exactly, so that its members agree with one another, which is harder.
inline void addFalseClosures(Problem& problem, double rate, int group, std::mt19937& rng) {
  const std::size_t true_ones = problem.closures.size();
  const std::size_t wanted = true_ones + static_cast<std::size_t>(rate * true_ones + 0.5);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> any_pose(0, problem.poses - 1 - group);
  std::uniform_int_distribution<std::size_t> any_closure(0, true_ones - 1);
  while (problem.closures.size() < wanted) {
    const int a = any_pose(rng), b = any_pose(rng);
    if (std::abs(a - b) <= group) continue;
    const Se2 first{0.3 * normal(rng), 0.3 * normal(rng), 10 * geometry::kPi / 180 * normal(rng)};
    const SquareRootInformation noise = problem.closures[any_closure(rng)].noise;
    for (int k = 0; k < group && problem.closures.size() < wanted; ++k) {
      const Eigen::Vector3d unit(normal(rng), normal(rng), normal(rng));
      const Se2 measured = inverse(inverse(problem.truth[a]) * problem.truth[a + k]) * first *
                           (inverse(problem.truth[b]) * problem.truth[b + k]);
      problem.closures.push_back({a + k, b + k,
                                  group > 1 ? plus(measured, noise.matrix().partialPivLu().solve(unit)) : measured,
                                  noise, true});
    }
  }
}

struct Setting {
  bool test = true;  // else every closure acts, under its loss
  Loss loss;
  ConsistencyOptions consistency;
};

struct Outcome {
  double error_m = 0;
  double seconds = 0;
  int tests = 0, true_refused = 0, false_accepted = 0;
};

/// Root mean square distance from the truth after the best rigid alignment [m].
inline double errorOf(const std::vector<Se2>& poses, const std::vector<Se2>& truth) {
  Eigen::Matrix2Xd a(2, poses.size()), b(2, poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    a.col(i) = poses[i].translation();
    b.col(i) = truth[i].translation();
  }
  a.colwise() -= a.rowwise().mean().eval();
  b.colwise() -= b.rowwise().mean().eval();
  const Eigen::Matrix2d h = a * b.transpose();
  const double turn = std::atan2(h(0, 1) - h(1, 0), h(0, 0) + h(1, 1));
  return std::sqrt((Eigen::Rotation2Dd(turn).toRotationMatrix() * a - b).squaredNorm() / poses.size());
}

inline FactorRecord recordOf(const Edge& edge, const std::vector<VariableId>& ids) {
  return {{ids[edge.a], ids[edge.b]}, std::make_shared<BetweenSe2>(edge.a_from_b), edge.noise};
}

/// Feeds a problem as the engine does: pose by pose, a test every `interval` poses and `patience` poses after a new
/// closure; or all at once.
class Run {
 public:
  Run(const Problem& problem, const Setting& setting) : problem_(problem), setting_(setting) {}

  Outcome incremental(int interval, int patience) {
    std::vector<std::vector<const Edge*>> closures_at(problem_.poses);
    for (const Edge& edge : problem_.closures) closures_at[std::max(edge.a, edge.b)].push_back(&edge);
    addPose(nullptr);
    int last_test = 0, waiting_since = -1;
    for (const Edge& edge : problem_.odometry) {
      addPose(&edge);
      const int i = edge.b;
      for (const Edge* closure : closures_at[i]) addClosure(*closure);
      if (!fresh_.empty() && waiting_since < 0) waiting_since = i;
      if (i - last_test < interval && (waiting_since < 0 || i - waiting_since < patience)) continue;
      test();
      last_test = i;
      waiting_since = -1;
    }
    test();
    return outcome();
  }

  Outcome batch() {
    addPose(nullptr);
    for (const Edge& edge : problem_.odometry) addPose(&edge);
    for (const Edge& edge : problem_.closures) addClosure(edge);
    test();
    return outcome();
  }

 private:
  void addPose(const Edge* edge) {
    const Se2 pose = edge ? se2FromValue(graph_.value(ids_[edge->a]).data()) * edge->a_from_b : Se2();
    ids_.push_back(graph_.addVariable(se2(), toValue(pose), ids_.empty()));
    if (edge) graph_.addFactor(recordOf(*edge, ids_));
  }
  void addClosure(const Edge& edge) {
    FactorRecord record = recordOf(edge, ids_);
    record.tags.hypothesis = true;
    record.weight = setting_.test ? 0 : 1;
    record.loss = setting_.loss;
    fresh_.push_back(graph_.addFactor(record));
    closures_.emplace_back(fresh_.back(), &edge);
  }
  void test() {
    const std::clock_t start = std::clock();
    if (setting_.test)
      testConsistency(graph_, fresh_, setting_.consistency);
    else
      solve(graph_);
    outcome_.seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
    ++outcome_.tests;
    fresh_.clear();
  }
  Outcome outcome() {
    outcome_.error_m = errorOf(valuesOf(graph_), problem_.truth);
    for (const auto& [id, edge] : closures_) {
      const bool acts = graph_.factor(id).weight > 0;
      outcome_.true_refused += !edge->is_false && !acts;
      outcome_.false_accepted += edge->is_false && acts;
    }
    return outcome_;
  }

  const Problem& problem_;
  const Setting& setting_;
  Graph graph_;
  std::vector<VariableId> ids_;
  std::vector<FactorId> fresh_;
  std::vector<std::pair<FactorId, const Edge*>> closures_;
  Outcome outcome_;
};

}  // namespace omnimapper::graph
