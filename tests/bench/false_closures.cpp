// False closures among the true ones of public pose graphs: which of them the consistency test refuses, and how much
// the map suffers. Every edge that is not odometry is a hypothesis. Prints Markdown tables, which
// doc/results/false_closures.md shows.
//
//   bench-false_closures --seeds 5
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "../graph/FalseClosures.h"

namespace {

using namespace omnimapper;
using geometry::Se2;
using graph::Edge;
using graph::Outcome;
using graph::Problem;
using graph::Setting;

// ---- The graphs -----------------------------------------------------------------------------------------------------

std::vector<Se2> readTruth(const std::string& path) {
  std::ifstream in(path);
  std::vector<Se2> truth;
  for (Se2 pose; in >> pose.x >> pose.y >> pose.yaw;) truth.push_back(pose);
  return truth;
}

/// The same graph with every measurement drawn anew from the truth, with the noise that its edge states.
Problem redrawn(Problem problem, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  for (std::vector<Edge>* edges : {&problem.odometry, &problem.closures})
    for (Edge& edge : *edges) {
      const Eigen::Vector3d unit(normal(rng), normal(rng), normal(rng));
      const Eigen::Vector3d error = edge.noise.matrix().partialPivLu().solve(unit);
      edge.a_from_b = plus(inverse(problem.truth[edge.a]) * problem.truth[edge.b], error);
    }
  return problem;
}

/// Loads a problem by name, with the measurements of the file or with new ones that are drawn from the truth. None if
/// the file is not on this machine.
std::optional<Problem> load(const std::string& name, std::mt19937& rng) {
  const std::string stem = name.substr(0, name.find('-'));
  const auto path = omnimapper::testing::sharedData("posegraphs/" + stem + ".g2o");
  if (!path) return std::nullopt;
  Problem problem = graph::fromG2o(*path);
  const auto truth = omnimapper::testing::sharedData("posegraphs/" + stem + ".nodes_groundtruth.dat");
  if (truth) problem.truth = readTruth(*truth);
  problem.has_truth = truth || name != stem;
  return name == stem ? problem : redrawn(problem, rng);
}

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
  Setting setting;
  if (method == "none" || method == "cauchy") setting.test = false;
  if (method == "cauchy") setting.loss = graph::Loss::cauchy(2);
  setting.consistency.method = method == "graduated" ? Method::graduated : Method::pairwise;
  return setting;
}

Outcome runOnce(const Problem& problem, const Setting& setting, const Flags& flags) {
  graph::Run run(problem, setting);
  return flags.batch ? run.batch() : run.incremental(flags.interval, flags.patience);
}

double median(std::vector<double> numbers) {
  std::nth_element(numbers.begin(), numbers.begin() + numbers.size() / 2, numbers.end());
  return numbers[numbers.size() / 2];
}

/// Results of all seeds for one row of the table.
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
    char against_clean[64] = "|";  // no ratio if the clean run is the reference, because its error is 0
    if (has_truth) std::snprintf(against_clean, sizeof against_clean, "%.3f | %.3f", median(ratios), largest(ratios));
    std::printf("| %s | %.4f | %.4f | %s | %.2f | %.2f | %g | %g of %zu | %.2f |\n", label.c_str(), median(errors),
                largest(errors), against_clean, median(refused), largest(refused), median(accepted), largest(accepted),
                false_ones, median(times));
    std::fflush(stdout);
  }
};

/// Prints the rows of one graph.
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
          graph::addFalseClosures(problem, percent / 100, group, rng);
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
  CLI::App app("Tests false closures among the true ones of public pose graphs.");
  Flags flags;
  app.add_option("--graph", flags.graphs,
                 "intel or manhattan; NAME-redrawn: with measurements drawn anew from the truth");
  app.add_option("--method", flags.methods, "none, cauchy, pairwise or graduated");
  app.add_option("--percent", flags.percents, "number of false closures, in percent of the true ones");
  app.add_option("--group", flags.groups, "number of false closures that agree with one another");
  app.add_option("--seeds", flags.seeds, "runs per row");
  app.add_option("--interval", flags.interval, "poses between tests");
  app.add_option("--patience", flags.patience, "poses between a new closure and its test");
  app.add_flag("--batch", flags.batch, "optimize everything at once, from chained odometry");
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
