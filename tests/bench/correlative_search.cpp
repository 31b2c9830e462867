// Times the search that a loop closure makes: a scan with a reference pose is searched in the map of the 20 such scans
// before it, from a guess that is off by up to 70 % of the window. Prints a Markdown table.
//
// Example: bench-correlative_search --logs ../shared/data/laser2d
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "ReferenceScans.h"

namespace {

using namespace omnimapper;
using mrpt::math::TPose2D;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr std::size_t kScans = 20;

struct Setting {
  double cell, half, half_yaw;  // [m] [m] [deg]
  int results;
};

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double quantile(std::vector<double>& values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

void row(const std::string& name, const std::vector<matching::MapScan>& scans, const Setting& setting) {
  testing::Dice dice(1);
  std::vector<double> build, search;
  int right = 0;
  for (std::size_t i = kScans; i < scans.size(); ++i) {
    matching::ScanWithNormals map;
    for (std::size_t k = i - kScans; k < i; ++k) {
      matching::append(matching::fitLines(scans[k].scan.hits), scans[k].map_from_sensor, map);
    }
    const TPose2D& truth = scans[i].map_from_sensor;
    const double most = 0.7 * setting.half, most_turn = 0.7 * setting.half_yaw * kDegree;
    const TPose2D guess(truth.x + dice.uniform(-most, most), truth.y + dice.uniform(-most, most),
                        truth.phi + dice.uniform(-most_turn, most_turn));
    grid::LikelihoodOptions grid;
    grid.cell = setting.cell;
    grid.sigma = 1.6 * setting.cell;
    matching::SearchOptions options;
    options.max_results = setting.results;
    const auto begin = std::chrono::steady_clock::now();
    const grid::LikelihoodPyramid pyramid(map.points, grid);
    build.push_back(millisecondsSince(begin));
    const auto searched = std::chrono::steady_clock::now();
    const auto results = matching::search(pyramid, matching::thinned(scans[i].scan.hits, 0.1),
                                          {guess, setting.half, setting.half, setting.half_yaw * kDegree}, options);
    search.push_back(millisecondsSince(searched));
    if (results.empty()) continue;
    const TPose2D& found = results[0].map_from_scan;
    if (std::hypot(found.x - truth.x, found.y - truth.y) < 0.25 &&
        std::abs(std::remainder(found.phi - truth.phi, 360 * kDegree)) < 3 * kDegree) {
      ++right;
    }
  }
  std::printf("| %s | %.2f | %.0f m, %.0f deg | %d | %.1f %% | %.2f, %.2f | %.2f, %.2f |\n", name.c_str(), setting.cell,
              setting.half, setting.half_yaw, setting.results, 100.0 * right / static_cast<double>(search.size()),
              quantile(build, 0.5), quantile(build, 0.95), quantile(search, 0.5), quantile(search, 0.95));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::string logs;
  std::vector<std::string> names{"aces", "intel"};
  CLI::App app("Times the correlative search in local maps.");
  app.add_option("--logs", logs, "folder with NAME.clf.bz2 and NAME.reference.tum")->required();
  app.add_option("--names", names, "names of the logs");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| log | cell [m] | half of the window | results | the best within 0.25 m, 3 deg | ms to make the grids: median, "
      "95 %% | ms to search |\n|---|---|---|---|---|---|---|\n");
  for (const auto& name : names) {
    const auto scans = bench::referenceScans(logs, name);
    for (const Setting& setting : {Setting{0.05, 3, 30, 1}, Setting{0.05, 3, 30, 3}, Setting{0.1, 3, 30, 1},
                                   Setting{0.1, 3, 30, 3}, Setting{0.1, 8, 180, 3}}) {
      row(name, scans, setting);
    }
  }
}
