// Public pose graphs, a pose at a time: each step adds the pose, from its odometry edge, and every edge to earlier
// poses. Prints a Markdown table of the processor time of a step, and how far the cost is above
// the batch minimum of the graph so far.
//
//   OPENBLAS_NUM_THREADS=1 OMP_THREAD_LIMIT=1 bench-graph_incremental [runs [relinearize_beyond [every
//   [substitute_beyond [graph]]]]]
//
// The time of a step is the median of the runs. Batch minima are computed at 20 steps, evenly spread.
#include <omnimapper/graph/G2o.h>
#include <omnimapper/graph/PoseByPose.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>

namespace {

using namespace omnimapper;
using graph::Graph;

struct Run {
  std::vector<double> seconds;  // of each step
  std::vector<double> above;    // cost over the batch minimum, at some steps
  double final_chi2 = 0;
  std::size_t eliminated = 0;
};

/// Of this thread, so that other programs on the machine count little.
double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Run runOnce(const Graph& whole, const graph::IncrementalOptions& options, bool compares) {
  Run run;
  graph::IncrementalSolver solver(options);
  graph::PoseByPose growth(whole);
  const std::size_t spacing = std::max<std::size_t>(growth.steps() / 20 / 10 * 10, 10);
  for (std::size_t i = 0; i < growth.steps(); ++i) {
    const auto added = growth.grow(solver);
    if (added.empty()) continue;
    const double start = processorSeconds();
    run.eliminated += solver.update(growth.graph(), {added, {}, {}, {}}).eliminated;
    run.seconds.push_back(processorSeconds() - start);
    if (!compares || i % spacing != 0) continue;
    Graph batch = growth.graph();
    solver.store(batch);
    const double cost = batch.cost();
    solve(batch);
    run.above.push_back(cost / batch.cost() - 1);
  }
  solver.store(growth.graph());
  run.final_chi2 = graph::g2oChi2(growth.graph());
  return run;
}

double quantile(std::vector<double> numbers, double share) {
  std::sort(numbers.begin(), numbers.end());
  return numbers[std::min(numbers.size() - 1, static_cast<std::size_t>(share * static_cast<double>(numbers.size())))];
}

void bench(const char* name, int runs, const graph::IncrementalOptions& options) {
  const Graph whole =
      graph::readG2o(*omnimapper::testing::sharedData(std::string("posegraphs/") + name + ".g2o")).graph;
  std::vector<Run> all;
  for (int i = 0; i < runs; ++i) all.push_back(runOnce(whole, options, i == 0));
  std::vector<double> steps;
  for (std::size_t i = 0; i < all.front().seconds.size(); ++i) {
    std::vector<double> times;
    for (const Run& run : all) times.push_back(1000 * run.seconds[i]);
    steps.push_back(quantile(times, 0.5));
  }
  const auto& above = all.front().above;
  std::printf("| %s | %zu | %.0f | %.3f | %.2f | %.2f | %.1f | %.0f | %.2f %% | %.2f %% | %.6g |\n", name, steps.size(),
              std::accumulate(steps.begin(), steps.end(), 0.0),
              std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size()),
              quantile(steps, 0.95), quantile(steps, 0.99), quantile(steps, 1),
              static_cast<double>(all.front().eliminated) / static_cast<double>(steps.size()),
              100 * quantile(above, 0.5), 100 * quantile(above, 1), all.front().final_chi2);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  graph::IncrementalOptions options;
  const int runs = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 5;
  if (argc > 2) options.relinearize_beyond = std::atof(argv[2]);
  if (argc > 3) options.relinearize_every = std::atoi(argv[3]);
  if (argc > 4) options.substitute_beyond = std::atof(argv[4]);
  std::printf(
      "| graph | steps | total [ms] | mean | p95 | p99 | max [ms] | eliminated a step | above the batch minimum: "
      "median | "
      "worst | final chi2 |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const char* name : {"intel", "manhattan", "parking-garage", "sphere2500", "city10000"})
    if (argc <= 5 || std::string(argv[5]) == name) bench(name, runs, options);
}
