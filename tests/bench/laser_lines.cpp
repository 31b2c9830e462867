// Straight walls in 2D scans by both of our methods and MRPT's RANSAC in one run: first in simulated rooms with
// clutter, whose truth is known, with several numbers of beams; then, if logs are given, how much the walls of
// consecutive scans differ while the robot hardly moves. Prints Markdown tables.
//
// Example: bench-laser_lines --log intel.clf.bz2 --log aces.clf.bz2
#include <mrpt/math/ransac_applications.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/random/RandomGenerators.h>
#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/LineScans.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "Timing.h"

namespace {

using namespace omnimapper;
using geometry::Segment2;
using mrpt::obs::CObservation2DRangeScan;
using Clock = std::chrono::steady_clock;
using Finder = std::function<std::vector<Segment2>(const CObservation2DRangeScan&)>;
using Lines = std::vector<Segment2>;

struct Method {
  std::string name;
  Finder find;
};

Lines ours(const perception::LaserLineExtractor& extractor, const CObservation2DRangeScan& scan) {
  Lines segments;
  const auto derived = extractor.extract(scan);
  for (const auto& line : derived->lines) segments.push_back(line.segment_in_sensor);
  return segments;
}

// Silences standard output: MRPT's RANSAC prints each of its iterations, which cannot be switched off and takes time.
struct Silence {
  Silence() : was(std::cout.rdbuf(nullptr)) {}
  ~Silence() {
    std::cout.rdbuf(was);
    std::cout.clear();
  }
  std::streambuf* was;
};

// MRPT's lines have no ends. They get the ends of their points, and are split at gaps as our lines are.
Lines mrptRansac(const CObservation2DRangeScan& scan, double threshold, const perception::LaserLineOptions& options) {
  std::vector<double> xs, ys;
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    const double range = scan.getScanRange(i);
    if (!scan.getScanRangeValidity(i) || range < options.min_range || range >= scan.maxRange) continue;
    const double angle = scan.aperture * (static_cast<double>(i) / static_cast<double>(scan.getScanSize() - 1) - 0.5);
    xs.push_back(range * std::cos(angle));
    ys.push_back(range * std::sin(angle));
  }
  mrpt::math::CVectorDouble x(xs.size()), y(xs.size());
  std::copy(xs.begin(), xs.end(), x.begin());
  std::copy(ys.begin(), ys.end(), y.begin());
  std::vector<std::pair<std::size_t, mrpt::math::TLine2D>> found;
  const Silence silence;
  mrpt::math::ransac_detect_2D_lines(x, y, found, threshold, static_cast<std::size_t>(options.min_points));
  Lines segments;
  for (const auto& [count, line] : found) {
    std::vector<std::size_t> run;
    const auto finish = [&] {
      if (static_cast<int>(run.size()) >= options.min_points) {
        const Segment2 segment{{xs[run.front()], ys[run.front()]}, {xs[run.back()], ys[run.back()]}};
        if (length(segment) >= options.min_length) segments.push_back(segment);
      }
      run.clear();
    };
    for (std::size_t i = 0; i < xs.size(); ++i) {
      if (line.distance({xs[i], ys[i]}) > threshold) continue;
      if (!run.empty() && i - run.back() > 1 &&
          std::hypot(xs[i] - xs[run.back()], ys[i] - ys[run.back()]) > options.max_gap)
        finish();
      run.push_back(i);
    }
    finish();
  }
  return segments;
}

double timeOf(const Finder& find, const CObservation2DRangeScan& scan) {
  const auto begin = Clock::now();
  find(scan);
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

void printRooms(const std::vector<Method>& methods, int rooms, int clutter) {
  std::printf(
      "%d rooms with %d objects in each for each row\n\n| beams | method | recall | precision | ends [cm] mean | "
      "median | time [ms] median | 95 %% |\n|---|---|---|---|---|---|---|---|\n",
      rooms, clutter);
  for (const int beams : {181, 361, 1081}) {
    testing::LineScanOptions options;
    options.beams = beams;
    options.clutter = clutter;
    if (beams == 1081) options.aperture = 1.5 * 3.14159265358979;
    testing::Dice dice(static_cast<std::uint64_t>(beams));
    std::vector<testing::LineScan> scans;
    for (int i = 0; i < rooms; ++i) scans.push_back(testing::drawLineScan(options, dice));
    for (const auto& method : methods) {
      testing::LineScore score;
      std::vector<double> times;
      for (const auto& truth : scans) {
        score.add(truth, method.find(truth.scan));
        times.push_back(timeOf(method.find, truth.scan));
      }
      std::printf("| %d | %s | %.3f | %.3f | %.2f | %.2f | %.4f | %.4f |\n", beams, method.name.c_str(), score.recall(),
                  score.precision(), 100 * score.meanEndError(), 100 * bench::quantile(score.end_errors, 0.5),
                  bench::quantile(times, 0.5), bench::quantile(times, 0.95));
      std::fflush(stdout);
    }
  }
}

struct Steadiness {
  int lines = 0, again = 0;
  std::vector<double> turns, offsets, times;  // [rad] [m] [ms]
};

// A line of the earlier scan is found again if a line of the later scan covers at least half of it.
void compare(const Lines& before, const Lines& after, Steadiness& result) {
  for (const auto& line : before) {
    if (length(line) < 1) continue;
    ++result.lines;
    const Eigen::Vector2d along = direction(line), across(-along.y(), along.x());
    double best = 0, turn = 0, offset = 0;
    for (const auto& other : after) {
      const double sine = direction(other).dot(across), off = (middle(other) - line.from).dot(across);
      if (std::abs(sine) > 0.1 || std::abs(off) > 0.1) continue;
      double low = (other.from - line.from).dot(along), high = (other.to - line.from).dot(along);
      if (low > high) std::swap(low, high);
      const double common = std::min(high, length(line)) - std::max(low, 0.0);
      if (common <= best) continue;
      best = common;
      turn = std::asin(std::abs(sine));
      offset = std::abs((middle(line) - other.from).dot(Eigen::Vector2d(-direction(other).y(), direction(other).x())));
    }
    if (best < 0.5 * length(line)) continue;
    ++result.again;
    result.turns.push_back(turn);
    result.offsets.push_back(offset);
  }
}

// Pairs of consecutive scans between which the odometry measures almost no motion.
std::vector<std::pair<CObservation2DRangeScan::Ptr, CObservation2DRangeScan::Ptr>> standingPairs(
    const std::string& path, std::size_t most) {
  const auto log = source::openLogs({path}, {});
  std::vector<std::pair<CObservation2DRangeScan::Ptr, CObservation2DRangeScan::Ptr>> pairs;
  CObservation2DRangeScan::Ptr last;
  mrpt::poses::CPose2D pose, last_pose;
  while (const auto observation = log->next()) {
    if (const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation))
      pose = odometry->odometry;
    const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
    if (!scan) continue;
    const auto motion = pose - last_pose;
    if (last && motion.norm() < 0.002 && std::abs(motion.phi()) < 0.001) pairs.emplace_back(last, scan);
    last = scan;
    last_pose = pose;
  }
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / most);
  std::vector<std::pair<CObservation2DRangeScan::Ptr, CObservation2DRangeScan::Ptr>> some;
  for (std::size_t i = 0; i < pairs.size(); i += step) some.push_back(pairs[i]);
  return some;
}

void printLogs(const std::vector<Method>& methods, const std::vector<std::string>& logs, std::size_t most) {
  if (logs.empty()) return;
  std::printf(
      "\nWalls of at least 1 m in consecutive scans of a robot that stands\n\n| log | pairs | method | walls per scan "
      "| "
      "seen again | turned [deg] median | 95 %% | shifted [mm] median | 95 %% | time [ms] median | 95 %% "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& log : logs) {
    const auto pairs = standingPairs(log, most);
    for (const auto& method : methods) {
      Steadiness result;
      for (const auto& [before, after] : pairs) {
        compare(method.find(*before), method.find(*after), result);
        result.times.push_back(timeOf(method.find, *after));
      }
      const double degree = 3.14159265358979 / 180;
      std::printf("| %s | %zu | %s | %.2f | %.1f %% | %.3f | %.3f | %.2f | %.2f | %.4f | %.4f |\n",
                  log.substr(log.rfind('/') + 1).c_str(), pairs.size(), method.name.c_str(),
                  double(result.lines) / double(std::max<std::size_t>(1, pairs.size())),
                  100.0 * result.again / std::max(1, result.lines), bench::quantile(result.turns, 0.5) / degree,
                  bench::quantile(result.turns, 0.95) / degree, 1000 * bench::quantile(result.offsets, 0.5),
                  1000 * bench::quantile(result.offsets, 0.95), bench::quantile(result.times, 0.5),
                  bench::quantile(result.times, 0.95));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> logs;
  int rooms = 200, clutter = 8;
  std::size_t most = 500;
  CLI::App app("Compares straight walls in 2D scans by our methods and MRPT's RANSAC.");
  app.add_option("--log", logs, "CARMEN logs in which walls of consecutive scans are compared");
  app.add_option("--rooms", rooms, "simulated scans for each number of beams");
  app.add_option("--clutter", clutter, "number of poles and boxes in each room");
  app.add_option("--pairs", most, "largest number of pairs of scans of each log, approximately");
  CLI11_PARSE(app, argc, argv);
  mrpt::random::getRandomGenerator().randomize(1);

  perception::LaserLineOptions split, ransac;
  ransac.method = perception::LaserLineOptions::Method::ransac;
  const perception::LaserLineExtractor by_split(split), by_ransac(ransac);
  const std::vector<Method> methods{
      {"split and merge", [&](const auto& scan) { return ours(by_split, scan); }},
      {"ransac", [&](const auto& scan) { return ours(by_ransac, scan); }},
      {"MRPT RANSAC, 3 cm", [&](const auto& scan) { return mrptRansac(scan, 0.03, split); }},
      {"MRPT RANSAC, 5 cm", [&](const auto& scan) { return mrptRansac(scan, 0.05, split); }}};
  printRooms(methods, rooms, clutter);
  printLogs(methods, logs, most);
}
