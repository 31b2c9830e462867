// Relocalization without a guess: each scan that has a reference or true pose is located in the map made of all the
// other scans at their poses. Prints a Markdown table, and writes a CSV with every scan and an SVG that shows where it
// failed.
//
// Example: bench-kidnapping --logs ../shared/data/laser2d -o out/kidnapping
#include <omnimapper/matching/PointToLineMatcher.h>
#include <omnimapper/matching/Relocalizer.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "ReferenceScans.h"

namespace {

using namespace omnimapper;
using matching::Location;
using matching::MapScan;
using mrpt::math::TPose2D;

constexpr double kPi = 3.14159265358979323846;
constexpr double kNear = 0.25;    // [m] largest error of a right answer
constexpr double kTurn = 3;       // [deg] the same
constexpr double kElsewhere = 1;  // [m] error above which a wrong answer is at another place

struct Outcome {
  Location location;
  double best_distance = INFINITY, best_turn = INFINITY;  // [m] [deg] of the first candidate
  int rank = -1;                                          // of the right candidate; -1: there is none
  double milliseconds = 0;

  bool found() const { return location.answer == Location::Answer::found; }
};

Outcome locate(const std::vector<MapScan>& scans, std::size_t left_out, const matching::RelocalizerOptions& options) {
  std::vector<MapScan> others = scans;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
  const matching::Relocalizer relocalizer(
      std::move(others), std::make_shared<matching::PointToLineMatcher>(matching::ScanMatcherOptions()), options);
  Outcome outcome;
  const auto begin = std::chrono::steady_clock::now();
  outcome.location = relocalizer.locate(scans[left_out].scan);
  outcome.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  const TPose2D& truth = scans[left_out].map_from_sensor;
  const auto& candidates = outcome.location.candidates;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const TPose2D& pose = candidates[k].map_from_sensor;
    const double distance = std::hypot(pose.x - truth.x, pose.y - truth.y),
                 degrees = std::abs(std::remainder(pose.phi - truth.phi, 2 * kPi)) * 180 / kPi;
    if (k == 0) {
      outcome.best_distance = distance;
      outcome.best_turn = degrees;
    }
    if (outcome.rank < 0 && distance < kNear && degrees < kTurn) outcome.rank = static_cast<int>(k);
  }
  return outcome;
}

std::vector<Outcome> locateAll(const std::vector<MapScan>& scans, int every, int threads,
                               const matching::RelocalizerOptions& options) {
  std::vector<Outcome> outcomes((scans.size() + every - 1) / every);
  std::vector<std::thread> workers;
  for (int first = 0; first < threads; ++first) {
    workers.emplace_back([&, first] {
      for (std::size_t k = first; k < outcomes.size(); k += threads) outcomes[k] = locate(scans, k * every, options);
    });
  }
  for (auto& worker : workers) worker.join();
  return outcomes;
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return NAN;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void printRow(const std::string& name, const std::vector<Outcome>& outcomes) {
  int right = 0, wrong = 0, elsewhere = 0, ambiguous = 0, none = 0, held = 0;
  std::vector<double> times, distances, turns;
  for (const Outcome& outcome : outcomes) {
    times.push_back(outcome.milliseconds);
    if (!outcome.found()) {
      ++(outcome.location.answer == Location::Answer::ambiguous ? ambiguous : none);
      if (outcome.rank >= 0) ++held;
    } else if (outcome.rank == 0) {
      ++right;
      distances.push_back(100 * outcome.best_distance);
      turns.push_back(outcome.best_turn);
    } else {
      ++wrong;
      if (outcome.best_distance > kElsewhere) ++elsewhere;
    }
  }
  std::printf("| %s | %zu | %.1f %% | %d (%d) | %d + %d | %d | %.1f cm, %.2f deg | %.0f, %.0f |\n", name.c_str(),
              outcomes.size(), 100.0 * right / static_cast<double>(outcomes.size()), wrong, elsewhere, ambiguous, none,
              held, quantile(distances, 0.5), quantile(turns, 0.5), quantile(times, 0.5), quantile(times, 0.95));
  std::fflush(stdout);
}

// Distance [m] and angle [rad] by which the likelihood of the beams moved a candidate from the matcher's pose.
std::pair<double, double> settled(const matching::LocationCandidate& candidate) {
  const auto& matched = candidate.match.reference_from_scan;
  const auto& pose = candidate.map_from_sensor;
  return {std::hypot(pose.x - matched.x, pose.y - matched.y),
          std::abs(std::remainder(pose.phi - matched.phi, 2 * kPi))};
}

void writeCsv(const std::string& path, const std::vector<Outcome>& outcomes, int every) {
  std::ofstream csv(path);
  csv << "scan,answer,rank_of_truth,distance_m,turn_deg,milliseconds,candidates (probability log_likelihood score "
         "overlap wall_distance_m x y yaw settled_m settled_rad)\n";
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const Outcome& outcome = outcomes[k];
    csv << k * every << "," << static_cast<int>(outcome.location.answer) << "," << outcome.rank << ","
        << outcome.best_distance << "," << outcome.best_turn << "," << outcome.milliseconds;
    for (const auto& c : outcome.location.candidates) {
      csv << "," << c.probability << " " << c.log_likelihood << " " << c.score << " " << c.match.overlap << " "
          << c.match.wall_distance << " " << c.map_from_sensor.x << " " << c.map_from_sensor.y << " "
          << c.map_from_sensor.phi << " " << settled(c).first << " " << settled(c).second;
    }
    csv << "\n";
  }
}

// Draws walls in grey and a dot for each scan: green if the answer is right, blue if there is none, red if it is wrong,
// with a line to the answer.
void writeSvg(const std::string& path, const std::vector<MapScan>& scans, const std::vector<Outcome>& outcomes,
              int every) {
  double low_x = INFINITY, low_y = INFINITY, high_x = -INFINITY, high_y = -INFINITY;
  for (const MapScan& scan : scans) {
    low_x = std::min(low_x, scan.map_from_sensor.x - 8);
    low_y = std::min(low_y, scan.map_from_sensor.y - 8);
    high_x = std::max(high_x, scan.map_from_sensor.x + 8);
    high_y = std::max(high_y, scan.map_from_sensor.y + 8);
  }
  std::ofstream svg(path);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" viewBox=\"" << low_x << " " << -high_y << " "
      << high_x - low_x << " " << high_y - low_y << "\">\n<rect x=\"" << low_x << "\" y=\"" << -high_y
      << "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n<path stroke=\"#bbb\" stroke-width=\"0.1\" "
         "stroke-linecap=\"round\" d=\"";
  svg.precision(4);
  for (std::size_t i = 0; i < scans.size(); i += 3) {
    matching::ScanWithNormals walls;
    matching::append({scans[i].scan.hits, {scans[i].scan.hits.size(), Eigen::Vector2f::Zero()}, {}, {}},
                     scans[i].map_from_sensor, walls);
    for (std::size_t k = 0; k < walls.size(); k += 4) {
      const auto& p = walls.points[k];
      if (p.x() > low_x && p.x() < high_x && p.y() > low_y && p.y() < high_y) {
        svg << "M" << p.x() << " " << -p.y() << "h0";
      }
    }
  }
  svg << "\"/>\n";
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const TPose2D& truth = scans[k * every].map_from_sensor;
    const bool wrong = outcomes[k].found() && outcomes[k].rank != 0;
    if (wrong) {
      const TPose2D& answer = outcomes[k].location.candidates.front().map_from_sensor;
      svg << "<path stroke=\"red\" stroke-width=\"0.1\" d=\"M" << truth.x << " " << -truth.y << "L" << answer.x << " "
          << -answer.y << "\"/>\n";
    }
    svg << "<circle r=\"" << (outcomes[k].found() && !wrong ? 0.15 : 0.35) << "\" cx=\"" << truth.x << "\" cy=\""
        << -truth.y << "\" fill=\""
        << (wrong                 ? "red"
            : outcomes[k].found() ? "green"
                                  : "blue")
        << "\"/>\n";
  }
  svg << "</svg>\n";
}

// The scans of a log of the folder or, if it has none of this name, of one of MRPT's simulated logs. These have 10
// scans a second, of which one every 0.5 m or 0.5 rad is used.
std::vector<MapScan> scansOf(const std::string& folder, const std::string& name) {
  if (std::filesystem::exists(folder + "/" + name + ".clf.bz2")) return bench::referenceScans(folder, name);
  const auto path =
      omnimapper::testing::mrptDataset("graphslam-engine-demos/action_observations_map/" + name + ".rawlog");
  if (!path) return {};
  source::RawlogSource log(*path);
  return bench::scansOf(log, eval::readMrptGroundTruth(*path + ".GT.txt"), 0.5, 0.5);
}

}  // namespace

int main(int argc, char** argv) {
  std::string logs, out;
  int every = 1, threads = 1;
  std::vector<std::string> names{"aces", "intel", "simul", "range_030_bearing_015"};
  matching::RelocalizerOptions options;
  CLI::App app("Locates each scan that has a reference pose in the map made of the others.");
  app.add_option("--logs", logs, "folder with NAME.clf.bz2 and NAME.reference.tum")->required();
  app.add_option("-o,--output", out, "folder for the CSV and SVG files")->required();
  app.add_option("--names", names,
                 "names of the logs; a name that is not in the folder is one of MRPT's simulated graph-SLAM logs");
  app.add_option("--every", every, "locate every n-th scan")->check(CLI::PositiveNumber);
  app.add_option("--threads", threads)->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  std::filesystem::create_directories(out);
  std::printf(
      "| log | scans | answered and right | confident mistakes (at another place) | not answered: ambiguous + nowhere "
      "| truth among their "
      "candidates | median error | ms per scan: median, 95 %% |\n|---|---|---|---|---|---|---|---|\n");
  for (const auto& name : names) {
    const auto scans = scansOf(logs, name);
    if (scans.empty()) continue;
    const auto outcomes = locateAll(scans, every, threads, options);
    printRow(name, outcomes);
    writeCsv(out + "/" + name + ".csv", outcomes, every);
    writeSvg(out + "/" + name + ".svg", scans, outcomes, every);
  }
}
