// Compares the drift of the simulator's wheel odometry with that of ACES over the same path: the simulated wheels drive
// the trajectory that was mapped from the recording. Prints a Markdown table and writes SVG plots.
//
// Example: bench-simulator_drift --log aces.clf.bz2 --trajectory out/aces/trajectory.tum -o doc/results
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/source/openLogs.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "../sim/SensorRun.h"
#include "../sim/SmallWorlds.h"
#include "CurvePlot.h"

namespace {

using namespace omnimapper;
using geometry::Se2;
using Poses = std::map<double, Se2>;  // by time [s]

constexpr double kDegrees = 180 / M_PI;
const std::vector<double> kDistances{1, 2, 4, 8, 16, 24, 48};  // [m]

std::optional<Se2> interpolate(const Poses& poses, double time) {
  const auto after = poses.lower_bound(time);
  if (after == poses.begin() || after == poses.end()) return {};
  const auto before = std::prev(after);
  if (after->first - before->first > 1) return {};
  const double share = (time - before->first) / (after->first - before->first);
  return geometry::plus(before->second, share * geometry::minus(after->second, before->second));
}

/// Errors over all stretches of one distance travelled.
struct Errors {
  double count = 0;
  double place = 0, heading = 0;  ///< of the end relative to the start: sums of squares [m^2, rad^2]
  double bent = 0;                ///< of all positions after the best rigid alignment of both stretches: sum [m^2]
  double mean_heading = 0;        ///< sum [rad]

  double rms(double Errors::*sum) const { return std::sqrt(this->*sum / count); }
};

// Mean squared distance between the positions of odometry and truth after the best rigid alignment of the stretch.
double bendOf(const std::vector<std::pair<Se2, Se2>>& both, std::size_t first, std::size_t last) {
  Eigen::Vector2d mean_a(0, 0), mean_b(0, 0);
  const double count = static_cast<double>(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) {
    mean_a += both[i].first.translation() / count;
    mean_b += both[i].second.translation() / count;
  }
  double cosine = 0, sine = 0, squares = 0;
  for (std::size_t i = first; i <= last; ++i) {
    const Eigen::Vector2d a = both[i].first.translation() - mean_a, b = both[i].second.translation() - mean_b;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
    squares += a.squaredNorm() + b.squaredNorm();
  }
  return std::max(0.0, squares - 2 * std::hypot(cosine, sine)) / count;
}

/// Poses of odometry and truth at the same times, and the distance travelled until each [m].
struct Pairs {
  std::vector<std::pair<Se2, Se2>> both;  // odometry, truth
  std::vector<double> travel;

  Pairs(const Poses& odometry, const Poses& truth, double lag) {
    for (const auto& [time, pose] : truth) {
      const auto measured = interpolate(odometry, time + lag);
      if (!measured) continue;
      travel.push_back(
          both.empty() ? 0 : travel.back() + (measured->translation() - both.back().first.translation()).norm());
      both.emplace_back(*measured, pose);
    }
  }
  /// Error of the end of a stretch relative to its start: measured - true.
  Eigen::Vector3d errorOver(std::size_t first, std::size_t last) const {
    return geometry::minus(geometry::inverse(both[first].second) * both[last].second,
                           geometry::inverse(both[first].first) * both[last].first);
  }
  /// Calls visit(first, last) for each stretch of this distance travelled [m].
  template <class Visit>
  void eachStretch(double length, const Visit& visit) const {
    for (std::size_t i = 0, j = 0; i < both.size(); ++i) {
      while (j < both.size() && travel[j] - travel[i] < length) ++j;
      if (j == both.size()) break;
      visit(i, j);
    }
  }
};

void add(const Poses& odometry, const Poses& truth, double lag, std::map<double, Errors>& sums) {
  const Pairs pairs(odometry, truth, lag);
  for (const double length : kDistances) {
    Errors& errors = sums[length];
    pairs.eachStretch(length, [&](std::size_t first, std::size_t last) {
      const Eigen::Vector3d error = pairs.errorOver(first, last);
      ++errors.count;
      errors.place += error.head<2>().squaredNorm();
      errors.heading += error.z() * error.z();
      errors.mean_heading += error.z();
      errors.bent += bendOf(pairs.both, first, last);
    });
  }
}

// Prints a least-squares fit of the heading error over stretches of 8 m: a part proportional to the turning (wrong
// wheel base), a part proportional to the distance travelled (unequal wheels), and the residual.
void printFit(const Poses& odometry, const Poses& truth, double lag) {
  const Pairs pairs(odometry, truth, lag);
  std::vector<double> turned{0};
  for (std::size_t i = 1; i < pairs.both.size(); ++i)
    turned.push_back(turned.back() + geometry::wrapToPi(pairs.both[i].second.yaw - pairs.both[i - 1].second.yaw));
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right(0, 0);
  double squares = 0, count = 0;
  pairs.eachStretch(8, [&](std::size_t first, std::size_t last) {
    const Eigen::Vector2d cause(turned[last] - turned[first], pairs.travel[last] - pairs.travel[first]);
    const double error = pairs.errorOver(first, last).z();
    normal += cause * cause.transpose();
    right += error * cause;
    squares += error * error;
    ++count;
  });
  const Eigen::Vector2d fit = normal.ldlt().solve(right);
  std::printf("Heading over 8 m: %.2f %% of the turning, %.3f deg a metre, %.2f deg remain\n\n", 100 * fit.x(),
              kDegrees * fit.y(), kDegrees * std::sqrt(std::max(0.0, (squares - fit.dot(right)) / count)));
}

// Stamps of the odometry may lag behind those of the scans. Returns the lag [s] at which short stretches agree best.
double lagOf(const Poses& odometry, const Poses& truth) {
  double best = 0, least = 1e9;
  for (double lag = -0.3; lag <= 0.3; lag += 0.02) {
    std::map<double, Errors> sums;
    add(odometry, truth, lag, sums);
    if (sums[1].rms(&Errors::heading) >= least) continue;
    least = sums[1].rms(&Errors::heading);
    best = lag;
  }
  return best;
}

Poses readOdometry(const std::string& path) {
  const auto log = source::openLogs({path}, {});
  Poses poses;
  while (const auto observation = log->next()) {
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get()))
      poses.emplace(base::unixSeconds(odometry->timestamp), geometry::fromMrpt(odometry->odometry));
  }
  return poses;
}

// Reads about two poses a second, because the noise of scan matching in each pose would count as turning of the robot.
Poses readTrajectory(const std::string& path) {
  Poses poses;
  for (const auto& pose : eval::readTum(path)) {
    const double time = base::unixSeconds(pose.stamp);
    if (poses.empty() || time - poses.rbegin()->first > 0.45)
      poses.emplace(time, geometry::project(pose.world_from_body));
  }
  return poses;
}

Poses simulate(const Poses& truth, const std::string& keys, std::uint64_t seed) {
  std::vector<sim::Track::Place> places;
  const double start = truth.begin()->first;
  for (const auto& [time, pose] : truth) places.push_back({time - start, geometry::lift(pose)});
  const double duration = places.back().time;
  const SensorRun run(small_worlds::oneRoom(6, 4), {sim::Track::Kind::motion, std::move(places)},
                      "class = Odometry\nrate_hz = 20\n" + keys, duration, seed);
  Poses poses;
  for (int k = 0; k < run.sensor().count(); ++k)
    poses.emplace(start + run.sensor().timeOf(k),
                  geometry::fromMrpt(run.measure<mrpt::obs::CObservationOdometry>(k)->odometry));
  return poses;
}

void plot(const std::string& path, const std::string& title, const std::string& unit, double factor,
          double Errors::*sum, const std::map<double, Errors>& recorded, const std::map<double, Errors>& simulated) {
  const auto curve = [&](const std::string& name, const std::string& colour, const std::map<double, Errors>& errors) {
    bench::PlottedCurve result{name, colour, {}};
    for (const auto& [distance, error] : errors) result.points.emplace_back(distance, factor * error.rms(sum));
    return result;
  };
  bench::plotCurves(path, title, "distance travelled [m]", "root mean square [" + unit + "]",
                    {curve("ACES", "#c0392b", recorded), curve("simulated", "#2471a3", simulated)});
}

void run(const std::string& log, const std::string& trajectory, const std::string& keys, const std::string& folder) {
  const Poses truth = readTrajectory(trajectory), odometry = readOdometry(log);
  const double lag = lagOf(odometry, truth);
  std::printf("Stamps of ACES's odometry lag by %.2f s\n\n", lag);
  printFit(odometry, truth, lag);
  std::map<double, Errors> recorded, simulated;
  add(odometry, truth, lag, recorded);
  for (std::uint64_t seed = 0; seed < 40; ++seed) add(simulate(truth, keys, seed), truth, 0, simulated);
  std::printf(
      "| distance travelled [m] | ACES: place [m] | simulated | ACES: shape [m] | simulated | ACES: heading [deg], its "
      "mean | simulated |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const double distance : kDistances) {
    const Errors &a = recorded[distance], &b = simulated[distance];
    std::printf("| %.0f | %.3f | %.3f | %.3f | %.3f | %.2f, %.2f | %.2f |\n", distance, a.rms(&Errors::place),
                b.rms(&Errors::place), a.rms(&Errors::bent), b.rms(&Errors::bent), kDegrees * a.rms(&Errors::heading),
                kDegrees * a.mean_heading / a.count, kDegrees * b.rms(&Errors::heading));
  }
  plot(folder + "/simulator_odometry_place.svg", "Odometry: error of the place over the distance travelled", "m", 1,
       &Errors::place, recorded, simulated);
  plot(folder + "/simulator_odometry_heading.svg", "Odometry: error of the heading over the distance travelled", "deg",
       kDegrees, &Errors::heading, recorded, simulated);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the drift of the simulator's wheel odometry with that of a CARMEN log over the same path.");
  std::string log, trajectory, keys, folder = ".";
  app.add_option("--log", log, "CARMEN log: aces.clf.bz2")->required();
  app.add_option("--trajectory", trajectory, "trajectory that omnimapper-graphslam mapped from it, TUM format")
      ->required();
  app.add_option("--keys", keys, "keys of the simulated odometry's section, one per line, that override its defaults");
  app.add_option("-o,--output", folder, "folder for the plots");
  CLI11_PARSE(app, argc, argv);
  try {
    run(log, trajectory, keys, folder);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
