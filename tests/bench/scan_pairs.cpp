// Matches pairs of scans of a CARMEN log whose relative poses were checked by hand, by our matcher and MRPT's ICP in
// one run and by any other program through files. The matches start first from the guess of the odometry, then from a
// grid of poses around the checked one, which gives the basin of convergence. Prints Markdown tables and draws the
// basin as SVG.
//
// Example: bench-scan_pairs --log aces.clf.bz2 --relations aces.relations --svg doc/results/scan_matching_basin.svg
// For another program, --tasks FILE writes the matches to be computed, and --peer NAME=FILE reads its results (see
// ScanPairs.h).
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/slam/CICP.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "BasinPlot.h"
#include "RecordedPairs.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
using Clock = std::chrono::steady_clock;

struct Method {
  std::string name;
  std::function<Outcome(const ScanPair&, const TPose2D&)> run;
};

double since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// The time includes everything from the points on: fitting lines in both scans, building the index, and matching.
Outcome matchLines(const matching::ScanMatcher& matcher, const ScanPair& pair, const TPose2D& start) {
  const auto begin = Clock::now();
  const auto reference = matcher.prepare(matching::fitLines(pair.reference->points));
  const auto found = matcher.match(*reference, matching::fitLines(pair.scan->points), {start});
  return {found.reference_from_scan, since(begin)};
}

// Without the time of preparing the scans, since in a map a scan is prepared once and matched often.
Outcome matchPrepared(const matching::ScanMatcher& matcher, const ScanPair& pair, const TPose2D& start) {
  const auto reference = matcher.prepare(matching::fitLines(pair.reference->points));
  const auto scan = matching::fitLines(pair.scan->points);
  const auto begin = Clock::now();
  const auto found = matcher.match(*reference, scan, {start});
  return {found.reference_from_scan, since(begin)};
}

mrpt::maps::CSimplePointsMap mapOf(const RecordedScan& scan) {
  mrpt::maps::CSimplePointsMap map;
  map.reserve(scan.points.size());
  for (const auto& p : scan.points) map.insertPointFast(p.x(), p.y(), 0);
  return map;
}

Outcome matchIcp(const ScanPair& pair, const TPose2D& start, mrpt::slam::TICPAlgorithm algorithm, unsigned decimation,
                 bool with_maps) {
  mrpt::slam::CICP icp;  // all other options are MRPT's defaults
  icp.options.ICP_algorithm = algorithm;
  icp.options.corresponding_points_decimation = decimation;
  icp.options.skip_cov_calculation = true;
  icp.options.skip_quality_calculation = true;
  auto begin = Clock::now();
  const auto reference = mapOf(*pair.reference), scan = mapOf(*pair.scan);
  if (!with_maps) {
    float x, y, squared;
    reference.kdTreeClosestPoint2D(0.F, 0.F, x, y, squared);  // builds its tree
    begin = Clock::now();
  }
  const auto found = icp.Align(&reference, &scan, mrpt::poses::CPose2D(start));
  return {found->getMeanVal().asTPose(), since(begin)};
}

std::vector<Method> methods(const matching::ScanMatcher& matcher) {
  const auto icp = [](auto algorithm, unsigned decimation, bool with_maps) {
    return [=](const ScanPair& pair, const TPose2D& start) {
      return matchIcp(pair, start, algorithm, decimation, with_maps);
    };
  };
  return {{"odometry guess",
           [](const auto&, const auto& start) {
             return Outcome{start, 0};
           }},
          {"PointToLineMatcher", [&](const auto& pair, const auto& start) { return matchLines(matcher, pair, start); }},
          {"PointToLineMatcher, scans prepared",
           [&](const auto& pair, const auto& start) { return matchPrepared(matcher, pair, start); }},
          {"MRPT ICP, every 5th point", icp(mrpt::slam::icpClassic, 5, true)},
          {"MRPT ICP, every 5th point, maps prepared", icp(mrpt::slam::icpClassic, 5, false)},
          {"MRPT ICP, every point", icp(mrpt::slam::icpClassic, 1, true)},
          {"MRPT ICP, every point, maps prepared", icp(mrpt::slam::icpClassic, 1, false)},
          {"MRPT ICP, Levenberg-Marquardt", icp(mrpt::slam::icpLevenbergMarquardt, 1, true)}};
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void printPairs(const std::string& name, const std::vector<ScanPair>& pairs, const std::vector<Outcome>& outcomes) {
  std::vector<double> distances, turns, times;
  int good = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    distances.push_back(100 * distance(outcomes[i].pose, pairs[i].truth));
    turns.push_back(turn(outcomes[i].pose, pairs[i].truth) / kDegree);
    times.push_back(outcomes[i].milliseconds);
    good += right(outcomes[i].pose, pairs[i].truth);
  }
  std::printf("| %s | %.2f | %.2f | %.1f | %.3f | %.2f | %.1f %% | %.4f | %.4f |\n", name.c_str(),
              quantile(distances, 0.5), quantile(distances, 0.95), quantile(distances, 1), quantile(turns, 0.5),
              quantile(turns, 0.95), 100.0 * good / static_cast<double>(pairs.size()), quantile(times, 0.5),
              quantile(times, 0.95));
  std::fflush(stdout);
}

void printBasin(const Basin& basin) {
  std::printf("| %s |", basin.name.c_str());
  for (const auto& [low, high] : kRings) {
    for (const auto& [flat, steep] : kTurns) std::printf(" %.1f |", 100 * basin.share(low, high, flat, steep));
  }
  std::printf(" %.1f %% |\n", 100 * basin.share(0, 9, 0, 9));
  std::fflush(stdout);
}

void printBasinHead() {
  std::printf("\nBasin: share [%%] of right matches, by distance and turn of the start\n\n| method |");
  std::string line = "\n|---|";
  for (const auto& [low, high] : kRings) {
    for (const auto& [flat, steep] : kTurns) {
      std::printf(" %.2g to %.2g m, %.0f to %.0f deg |", low, high, flat / kDegree, steep / kDegree);
      line += "---|";
    }
  }
  std::printf(" all |%s---|\n", line.c_str());
}

std::vector<Eigen::Vector2f> simulateScan(const testing::FloorPlan& plan, const TPose2D& pose, testing::Dice& dice) {
  std::vector<Eigen::Vector2f> points;
  for (int i = -90; i < 90; ++i) {
    const double angle = i * kDegree;
    const double range =
        plan.distanceToWall({pose.x, pose.y}, {std::cos(pose.phi + angle), std::sin(pose.phi + angle)}) +
        dice.normal(0.01);
    if (range < 8) points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return points;
}

// A bare corridor that is 3 m wide, with beams up to 8 m: scans do not determine the motion along it.
void printCorridor(const matching::ScanMatcher& matcher) {
  testing::FloorPlan corridor;
  corridor.addPolygon({{-60, -1.5}, {60, -1.5}, {60, 1.5}, {-60, 1.5}});
  testing::Dice dice(1);
  const int matches = 100;
  int degenerate = 0;
  double invented = 0, across = 0, turned = 0, off = 0;
  for (int i = 0; i < matches; ++i) {
    const TPose2D motion(dice.uniform(-0.5, 0.5), dice.uniform(-0.3, 0.3), dice.uniform(-20, 20) * kDegree);
    const TPose2D guess = motion + TPose2D(dice.normal(0.2), dice.normal(0.1), dice.normal(3 * kDegree));
    const auto reference = matcher.prepare(matching::fitLines(simulateScan(corridor, {0, 0, 0}, dice)));
    const auto found = matcher.match(*reference, matching::fitLines(simulateScan(corridor, motion, dice)), guess);
    degenerate += found.degenerate;
    const auto& pose = found.reference_from_scan;
    invented = std::max(invented, std::abs(pose.x - guess.x));
    across = std::max(across, std::abs(pose.y - motion.y));
    turned = std::max(turned, turn(pose, motion));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(found.unit_covariance);
    const auto open = eigen.eigenvectors().col(2);
    off = std::max(off, std::abs(std::remainder(std::atan2(open.y(), open.x()) + pose.phi, 180 * kDegree)));
  }
  std::printf(
      "\nBare corridor, %d simulated matches: %d report an undetermined direction, at most %.2f deg from the "
      "corridor's; largest motion estimated along it %.1f cm; largest error across %.1f cm, of the heading %.2f deg\n",
      matches, degenerate, off / kDegree, 100 * invented, 100 * across, turned / kDegree);
}

}  // namespace

int main(int argc, char** argv) {
  std::string log, relations, svg, tasks_file, label = "FLASER", only;
  std::vector<std::string> peers, basin_peers;
  std::size_t basin_every = 24;
  CLI::App app("Compares matches of pairs of scans by our matcher, MRPT's and others.");
  app.add_option("--log", log, "CARMEN log with 180 beams")->required();
  app.add_option("--relations", relations, "file of relative poses that were checked by hand")->required();
  app.add_option("--svg", svg, "file for a drawing of the basin");
  app.add_option("--tasks", tasks_file, "file for the matches that another program is to compute");
  app.add_option("--peer", peers, "NAME=FILE with the results of another program");
  app.add_option("--basin-every", basin_every, "compute the basin for every n-th pair; 0: none");
  app.add_option("--only", only, "only methods whose name begins with this text");
  CLI11_PARSE(app, argc, argv);

  const auto scans = readScans(log, label);
  const auto pairs = pairsOf(scans, eval::readRelations(relations));
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < pairs.size(); ++i) tasks.push_back({i, pairs[i].guess});
  const auto starts = basin_every > 0 ? basinStarts() : std::vector<TPose2D>();
  for (std::size_t i = 0; i < pairs.size() && basin_every > 0; i += basin_every) {
    for (const auto& offset : starts) tasks.push_back({i, pairs[i].truth + offset});
  }
  if (!tasks_file.empty()) writeTasks(tasks_file, pairs, tasks);

  std::printf(
      "%zu pairs\n\n| method | distance [cm] median | 95 %% | max | turn [deg] median | 95 %% | within 10 cm and 2 deg "
      "| time [ms] median | 95 %% |\n|---|---|---|---|---|---|---|---|---|\n",
      pairs.size());
  std::vector<Basin> basins;
  const auto show = [&](const std::string& name, const std::vector<Outcome>& outcomes, bool with_basin) {
    printPairs(name, pairs, outcomes);
    if (!with_basin || starts.empty()) return;
    Basin basin{name, {}};
    for (std::size_t i = pairs.size(); i < tasks.size(); ++i) {
      basin.starts.push_back(
          {starts[(i - pairs.size()) % starts.size()], right(outcomes[i].pose, pairs[tasks[i].pair].truth)});
    }
    basins.push_back(std::move(basin));
  };
  const auto matcher = matching::makeMatcher({});
  for (const auto& [name, run] : methods(*matcher)) {
    if (name.compare(0, only.size(), only) != 0) continue;
    const bool with_basin = name.find("prepared") == std::string::npos && name.find("guess") == std::string::npos;
    std::vector<Outcome> outcomes;
    for (std::size_t i = 0; i < (with_basin ? tasks.size() : pairs.size()); ++i) {
      outcomes.push_back(run(pairs[tasks[i].pair], tasks[i].start));
    }
    show(name, outcomes, with_basin);
  }
  for (const auto& peer : peers) {
    const auto sign = peer.find('=');
    show(peer.substr(0, sign), readOutcomes(peer.substr(sign + 1), tasks.size()), true);
  }
  printCorridor(*matcher);
  if (basins.empty()) return 0;
  printBasinHead();
  for (const auto& basin : basins) printBasin(basin);
  if (!svg.empty()) {
    std::ofstream out(svg);
    plotBasins(out, basins);
  }
}
