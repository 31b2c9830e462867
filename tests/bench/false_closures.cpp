// False closures among the true ones of public pose graphs: what the consistency test refuses, and what is left of the
// map. Every edge that is not odometry is a hypothesis. Prints Markdown tables; doc/results/robustness.md shows them.
//
//   bench-false_closures --seeds 5
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Consistency.h>
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/Initialisation.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/testing/Fixtures.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <random>

namespace {

using namespace omnimapper;
using base::FactorId;
using base::VariableId;
using geometry::Se2;
using graph::Graph;

struct Edge {
  int a, b;
  Se2 a_from_b;
  graph::SquareRootInformation noise;
  bool is_false = false;
};

/// A planar pose graph: odometry that is trusted, closures that are not, and where the poses should come out.
struct Problem {
  std::string name;
  int poses = 0;
  std::vector<Edge> odometry, closures;
  std::vector<Se2> truth;
  bool has_truth = false;  // else the optimum stands for it
};

// ---- The graphs -----------------------------------------------------------------------------------------------------

std::vector<Se2> valuesOf(const Graph& graph) {
  std::vector<Se2> poses;
  for (const auto& [id, record] : graph.variables()) poses.push_back(graph::se2FromValue(record.value.data()));
  return poses;
}

/// Poses of the file in the order of their numbers; truth is the optimum of what the file holds.
Problem fromG2o(const std::string& name, const std::string& path) {
  graph::G2oContent content = graph::readG2o(path);
  Problem problem;
  problem.name = name;
  std::map<VariableId, int> numbers;
  for (const auto& [number, id] : content.ids) numbers[id] = problem.poses++;
  for (const auto& [id, record] : content.graph.factors()) {
    const int a = numbers.at(record.variables[0]), b = numbers.at(record.variables[1]);
    const Edge edge{a, b, dynamic_cast<const graph::BetweenSe2&>(*record.factor).measured(), record.noise};
    (b == a + 1 ? problem.odometry : problem.closures).push_back(edge);
  }
  graph::solve(content.graph);
  problem.truth.resize(problem.poses);
  for (const auto& [id, number] : numbers) problem.truth[number] = graph::se2FromValue(content.graph.value(id).data());
  return problem;
}

std::vector<Se2> readTruth(const std::string& path) {
  std::ifstream in(path);
  std::vector<Se2> truth;
  for (Se2 pose; in >> pose.x >> pose.y >> pose.yaw;) truth.push_back(pose);
  return truth;
}

/// The same graph with every measurement drawn anew from the truth, with the noise it claims.
Problem redrawn(Problem problem, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  for (std::vector<Edge>* edges : {&problem.odometry, &problem.closures})
    for (Edge& edge : *edges) {
      const Eigen::Vector3d unit(normal(rng), normal(rng), normal(rng));
      const Eigen::Vector3d error = edge.noise.matrix().partialPivLu().solve(unit);
      edge.a_from_b = plus(inverse(problem.truth[edge.a]) * problem.truth[edge.b], error);
    }
  problem.name += " redrawn";
  return problem;
}

/// The problems by name: the file's measurements, or drawn anew from a truth. None without the recording.
std::optional<Problem> load(const std::string& name, std::mt19937& rng) {
  const std::string stem = name.substr(0, name.find('-'));
  const auto path = omnimapper::testing::sharedData("posegraphs/" + stem + ".g2o");
  if (!path) return std::nullopt;
  Problem problem = fromG2o(stem, *path);
  const auto truth = omnimapper::testing::sharedData("posegraphs/" + stem + ".nodes_groundtruth.dat");
  if (truth) problem.truth = readTruth(*truth);
  problem.has_truth = truth || name != stem;
  return name == stem ? problem : redrawn(problem, rng);
}

// ---- False closures -------------------------------------------------------------------------------------------------

/// As many as `rate` of the true ones, in groups. As Vertigo makes them: any two places are taken for one, give or take
/// 0.3 m and 10 deg; a group of k goes on along both ways for k steps. Harder than Vertigo's, the group follows the two
/// ways truly, so that its members agree with one another.
void addFalseClosures(Problem& problem, double rate, int group, std::mt19937& rng) {
  const std::size_t true_ones = problem.closures.size();
  const std::size_t wanted = true_ones + static_cast<std::size_t>(rate * true_ones + 0.5);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> any_pose(0, problem.poses - 1 - group);
  std::uniform_int_distribution<std::size_t> any_closure(0, true_ones - 1);
  while (problem.closures.size() < wanted) {
    const int a = any_pose(rng), b = any_pose(rng);
    if (std::abs(a - b) <= group) continue;
    const Se2 first{0.3 * normal(rng), 0.3 * normal(rng), 10 * geometry::kPi / 180 * normal(rng)};
    const graph::SquareRootInformation noise = problem.closures[any_closure(rng)].noise;
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

// ---- Runs -----------------------------------------------------------------------------------------------------------

struct Setting {
  std::string name;
  bool test = true;
  graph::Loss loss;
  graph::ConsistencyOptions consistency;
};

struct Outcome {
  double error_m = 0;
  double seconds = 0;
  int tests = 0, true_refused = 0, false_accepted = 0;
};

/// Root mean square distance from the truth after the best rigid alignment [m].
double errorOf(const std::vector<Se2>& poses, const std::vector<Se2>& truth) {
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

graph::FactorRecord recordOf(const Edge& edge, const std::vector<VariableId>& ids) {
  return {{ids[edge.a], ids[edge.b]}, std::make_shared<graph::BetweenSe2>(edge.a_from_b), edge.noise};
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
    const Se2 pose = edge ? graph::se2FromValue(graph_.value(ids_[edge->a]).data()) * edge->a_from_b : Se2();
    ids_.push_back(graph_.addVariable(graph::se2(), graph::toValue(pose), ids_.empty()));
    if (edge) graph_.addFactor(recordOf(*edge, ids_));
  }
  void addClosure(const Edge& edge) {
    graph::FactorRecord record = recordOf(edge, ids_);
    record.tags.hypothesis = true;
    record.weight = setting_.test ? 0 : 1;
    record.loss = setting_.loss;
    fresh_.push_back(graph_.addFactor(record));
    closures_.emplace_back(fresh_.back(), &edge);
  }
  void test() {
    const std::clock_t start = std::clock();
    if (setting_.test)
      graph::testConsistency(graph_, fresh_, setting_.consistency);
    else
      graph::solve(graph_);
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

// ---- Tables ---------------------------------------------------------------------------------------------------------

struct Flags {
  std::vector<std::string> graphs = {"intel", "intel-redrawn", "manhattan"};
  std::vector<std::string> methods = {"none", "cauchy", "pairwise", "graduated"};
  std::vector<double> percents = {0, 1, 10, 50};
  std::vector<int> groups = {1, 10};
  bool batch = false;
  int seeds = 5, interval = 100, patience = 10;
};

Setting settingOf(const std::string& method) {
  using Method = graph::ConsistencyOptions::Method;
  Setting setting{method, true, {}, {}};
  if (method == "none" || method == "cauchy") setting.test = false;
  if (method == "cauchy") setting.loss = graph::Loss::cauchy(2);
  setting.consistency.method = method == "graduated" ? Method::graduated : Method::pairwise;
  return setting;
}

Outcome runOnce(const Problem& problem, const Setting& setting, const Flags& flags) {
  Run run(problem, setting);
  return flags.batch ? run.batch() : run.incremental(flags.interval, flags.patience);
}

double median(std::vector<double> numbers) {
  std::nth_element(numbers.begin(), numbers.begin() + numbers.size() / 2, numbers.end());
  return numbers[numbers.size() / 2];
}

/// What the seeds gave for one row of the table.
struct Row {
  bool has_truth = true;
  std::vector<double> errors, ratios, times, refused, accepted;
  std::size_t false_ones = 0;

  void add(const Outcome& outcome, const Outcome& clean, std::size_t true_ones, std::size_t false_ones_added) {
    false_ones = false_ones_added;
    errors.push_back(outcome.error_m);
    ratios.push_back(outcome.error_m / clean.error_m);
    times.push_back(outcome.seconds / clean.seconds);
    refused.push_back(100.0 * outcome.true_refused / static_cast<double>(true_ones));
    accepted.push_back(outcome.false_accepted);
  }
  void print(const std::string& label) const {
    const auto largest = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
    char against_clean[64] = "|";  // against the optimum itself there is no ratio
    if (has_truth) std::snprintf(against_clean, sizeof against_clean, "%.3f | %.3f", median(ratios), largest(ratios));
    std::printf("| %s | %.4f | %.4f | %s | %.2f | %.2f | %g | %g of %zu | %.2f |\n", label.c_str(), median(errors),
                largest(errors), against_clean, median(refused), largest(refused), median(accepted), largest(accepted),
                false_ones, median(times));
    std::fflush(stdout);
  }
};

/// The rows of one graph.
void table(const std::string& graph_name, const Flags& flags) {
  const bool redrawn = graph_name.find('-') != std::string::npos;
  std::vector<Problem> problems;
  std::vector<Outcome> clean;
  for (int seed = 1; seed <= (redrawn ? flags.seeds : 1); ++seed) {
    std::mt19937 rng(static_cast<unsigned>(seed));
    std::optional<Problem> problem = load(graph_name, rng);
    if (!problem) {
      std::printf("%s: recording not on this machine\n", graph_name.c_str());
      return;
    }
    problems.push_back(*problem);
    clean.push_back(runOnce(*problem, settingOf("none"), flags));
  }
  for (const double percent : flags.percents)
    for (const int group : flags.groups)
      for (const std::string& method : flags.methods) {
        if (percent == 0 && group != flags.groups.front()) continue;
        Row row;
        row.has_truth = problems[0].has_truth;
        const int seeds = percent > 0 || redrawn ? flags.seeds : 1;
        for (int seed = 1; seed <= seeds; ++seed) {
          const std::size_t at = redrawn ? static_cast<std::size_t>(seed - 1) : 0;
          Problem problem = problems[at];
          std::mt19937 rng(static_cast<unsigned>(100 + seed));
          addFalseClosures(problem, percent / 100, group, rng);
          const std::size_t true_ones = problems[at].closures.size();
          row.add(runOnce(problem, settingOf(method), flags), clean[at], true_ones,
                  problem.closures.size() - true_ones);
        }
        char share[32];
        std::snprintf(share, sizeof share, "%g %%%s", percent, percent == 0 ? "" : group > 1 ? " grouped" : " random");
        row.print(graph_name + " | " + share + " | " + method);
      }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("False closures among the true ones of public pose graphs");
  Flags flags;
  app.add_option("--graph", flags.graphs, "intel, manhattan; NAME-redrawn: measurements drawn anew from the truth");
  app.add_option("--method", flags.methods, "none, cauchy, pairwise, graduated");
  app.add_option("--percent", flags.percents, "false closures, of the true ones");
  app.add_option("--group", flags.groups, "false closures that agree with one another");
  app.add_option("--seeds", flags.seeds, "runs of each row");
  app.add_option("--interval", flags.interval, "poses between tests");
  app.add_option("--patience", flags.patience, "poses between a new closure and its test");
  app.add_flag("--batch", flags.batch, "everything at once, from chained odometry");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| graph | false closures | method | error [m] | worst | error / clean | worst | true refused [%%] | worst | "
      "false "
      "accepted "
      "| worst | time / clean |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  try {
    for (const std::string& name : flags.graphs) table(name, flags);
  } catch (const base::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
