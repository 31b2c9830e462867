// Markers that are moved while the robot is elsewhere (thesis 4.6.3): how many of them are detected, how many others
// are taken for moved, and how the error of the trajectory changes, over worlds and drives of many seeds. Prints a
// Markdown table, and draws one of the maps. With --together nothing is carried away. Instead the given share of all
// markers moves by one metre in one direction while the robot is in the corridor (thesis 4.6.4), and the table has a
// row for each share.
//
// Examples: bench-moveable_things --seeds 50 --svg doc/results/moveable_things.svg
//           bench-moveable_things --seeds 10 --together 0.1 0.5 1 --laser
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include "dynamic/MovedThingPayload.h"
#include "points/PointPayload.h"

namespace {

using namespace omnimapper;
using mrpt::obs::CObservationBearingRange;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

/// Markers that all move by the same vector at the same time.
struct Together {
  double share = 0;       // of all markers
  double distance = 1;    // [m]
  double time = 36;       // [s]; in rawlogs/two_offices.ini the robot is in the corridor then
  std::set<int> numbers;  // of the markers that move
  Eigen::Vector3d shift{0, 0, 0};

  void choose(const sim::World& world, std::size_t seed) {
    std::vector<int> all;
    for (const auto& point : world.point_landmarks) all.push_back(point.id);
    std::mt19937 random(static_cast<unsigned>(seed));
    std::shuffle(all.begin(), all.end(), random);
    all.resize(static_cast<std::size_t>(std::lround(share * static_cast<double>(all.size()))));
    numbers.insert(all.begin(), all.end());
    const double angle = std::uniform_real_distribution<double>(0, 2 * geometry::kPi)(random);
    shift = distance * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  }
};

/// A simulated drive with its observations and its truth.
struct Drive {
  sim::Simulation simulation;
  Observations observations;
  Together together;

  Drive(const base::Config& config, Together with, std::size_t seed) : simulation(config), together(std::move(with)) {
    std::multimap<double, mrpt::obs::CObservation::Ptr> in_order;
    for (const auto& sensor : simulation.sensors()) {
      for (int k = 0; k < sensor->count(); ++k) {
        if (auto observation = sensor->measure(k).observation) in_order.emplace(sensor->arrivalOf(k), observation);
      }
    }
    for (const auto& [time, observation] : in_order) observations.push_back(observation);
    together.choose(simulation.world(), seed);
    for (const auto& observation : observations) moveTogether(*observation);
  }
  /// Changes measurements after the move so that they are of the new position, with their original noise.
  void moveTogether(mrpt::obs::CObservation& observation) const {
    auto* measured = dynamic_cast<CObservationBearingRange*>(&observation);
    if (!measured || secondsAt(measured->timestamp) < together.time) return;
    const auto map_from_sensor = *simulation.mapFromBase().at(secondsAt(measured->timestamp)) *
                                 geometry::fromMrpt(measured->sensorLocationOnRobot);
    const Eigen::Vector3d shift = map_from_sensor.rotation.conjugate() * together.shift;
    for (auto& one : measured->sensedData) {
      if (together.numbers.count(one.landmarkID) == 0) continue;
      const double level = one.range * std::cos(one.pitch);
      const Eigen::Vector3d there = shift + Eigen::Vector3d(level * std::cos(one.yaw), level * std::sin(one.yaw),
                                                            -one.range * std::sin(one.pitch));
      one.range = static_cast<float>(there.norm());
      one.yaw = static_cast<float>(std::atan2(there.y(), there.x()));
      one.pitch = static_cast<float>(std::asin(-there.z() / there.norm()));
    }
  }
  double secondsAt(base::Stamp stamp) const { return base::secondsBetween(simulation.start(), stamp); }
  /// Position of a landmark at a time [m, frame of the world].
  Eigen::Vector3d placeOf(const sim::PointLandmark& point, double time) const {
    const bool is_moved = time >= together.time && together.numbers.count(point.id) > 0;
    const Eigen::Vector3d shift = is_moved ? together.shift : Eigen::Vector3d::Zero();
    for (const auto& body : simulation.world().bodies)
      if (body.name == point.body) return *body.track.at(std::max(time, 0.0)) * point.in_body + shift;
    return point.in_body + shift;
  }
  /// Numbers of the landmarks whose position at the end differs from that at the start.
  std::set<int> moved() const {
    std::set<int> numbers;
    for (const auto& point : simulation.world().point_landmarks)
      if ((placeOf(point, 0) - placeOf(point, simulation.duration())).norm() > 0.01) numbers.insert(point.id);
    return numbers;
  }
  /// Numbers of the moved landmarks that key frames of `view` measured at least twice at each of their two positions.
  std::set<int> movedAndSeenInBoth(const mapper::View& view) const {
    std::map<int, std::map<bool, int>> measurements;
    std::map<int, const sim::PointLandmark*> points;
    for (const auto& point : simulation.world().point_landmarks) points[point.id] = &point;
    for (const auto& frame : view.map.key_frames) {
      for (const auto& observation : frame.observations) {
        const auto* measured = dynamic_cast<const CObservationBearingRange*>(observation.get());
        if (!measured) continue;
        for (const auto& one : measured->sensedData) {
          const auto& point = *points.at(one.landmarkID);
          const bool at_first = (placeOf(point, secondsAt(frame.stamp)) - placeOf(point, 0)).norm() < 0.01;
          ++measurements[one.landmarkID][at_first];
        }
      }
    }
    std::set<int> both;
    for (const int number : moved())
      if (measurements[number][true] > 1 && measurements[number][false] > 1) both.insert(number);
    return both;
  }
  /// Root mean square error [m] of the key frames, relative to the first of them.
  double trajectoryError(const mapper::View& view) const {
    const auto truthAt = [&](base::Stamp stamp) { return *simulation.mapFromBase().at(secondsAt(stamp)); };
    const auto first = truthAt(view.map.key_frames.front().stamp);
    double sum = 0;
    for (const auto& frame : view.map.key_frames) {
      const auto truth = inverse(first) * truthAt(frame.stamp);
      sum +=
          (truth.translation.head<2>() - geometry::fromMrpt(frame.map_from_base).translation.head<2>()).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(view.map.key_frames.size()));
  }
};

Observations withoutNumbers(const Observations& all, const std::set<int>& numbers) {
  Observations kept;
  for (const auto& observation : all) {
    const auto* measured = dynamic_cast<const CObservationBearingRange*>(observation.get());
    if (!measured) {
      kept.push_back(observation);
      continue;
    }
    auto copy = std::make_shared<CObservationBearingRange>(*measured);
    auto& data = copy->sensedData;
    data.erase(std::remove_if(data.begin(), data.end(), [&](const auto& one) { return numbers.count(one.landmarkID); }),
               data.end());
    kept.push_back(copy);
  }
  return kept;
}

std::set<int> foundMoved(const mapper::View& view) {
  std::set<int> numbers;
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto* payload = dynamic_cast<const plugins::MovedThingPayload*>(landmark.payload.get());
    if (!payload) continue;
    const auto& gone = view.map.landmark(payload->landmark);
    numbers.insert(dynamic_cast<const plugins::PointPayload&>(*gone.payload).number);
  }
  return numbers;
}

std::size_t countOf(const std::set<int>& all, const std::set<int>& among) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](int number) { return among.count(number) > 0; }));
}

// Draws poses in red, landmarks in green and moved landmarks in blue with dotted lines, as in Figure 49 of the thesis.
void draw(const mapper::View& view, const std::string& path) {
  std::vector<Eigen::Vector3d> poses, points;
  std::vector<map::LandmarkShape> moved;
  for (const auto& frame : view.map.key_frames) poses.push_back(geometry::fromMrpt(frame.map_from_base).translation);
  for (const auto& [id, landmark] : view.map.landmarks) {
    std::vector<Eigen::VectorXd> values;
    for (const auto variable : landmark.variables) values.push_back(view.graph.value(variable));
    const auto shape = landmark.payload->shape(values, view.map.key_frames);
    if (landmark.kind == "moved thing")
      moved.push_back(shape);
    else if (landmark.state == map::Landmark::State::active)
      points.insert(points.end(), shape.points.begin(), shape.points.end());
  }
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  const auto reach = [&](const Eigen::Vector3d& p) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  };
  for (const auto& p : poses) reach(p);
  for (const auto& p : points) reach(p);
  for (const auto& shape : moved)
    for (const auto& p : shape.points) reach(p);
  constexpr double kScale = 40, kMargin = 0.5;  // [pixels/m] [m]
  const auto x = [&](const Eigen::Vector3d& p) { return kScale * (p.x() - low.x() + kMargin); };
  const auto y = [&](const Eigen::Vector3d& p) { return kScale * (high.y() - p.y() + kMargin); };
  std::ofstream out(path);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kScale * (high.x() - low.x() + 2 * kMargin)
      << "\" height=\"" << kScale * (high.y() - low.y() + 2 * kMargin)
      << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<polyline fill=\"none\" stroke=\"#f0a0a0\" "
         "points=\"";
  for (const auto& p : poses) out << x(p) << ',' << y(p) << ' ';
  out << "\"/>\n";
  const auto dot = [&](const Eigen::Vector3d& p, double radius, const char* colour) {
    out << "<circle cx=\"" << x(p) << "\" cy=\"" << y(p) << "\" r=\"" << radius << "\" fill=\"" << colour << "\"/>\n";
  };
  for (const auto& p : poses) dot(p, 1.5, "red");
  for (const auto& p : points) dot(p, 4, "green");
  for (const auto& shape : moved) {
    for (std::size_t i = 1; i < shape.points.size(); ++i)
      out << "<line x1=\"" << x(shape.points[i - 1]) << "\" y1=\"" << y(shape.points[i - 1]) << "\" x2=\""
          << x(shape.points[i]) << "\" y2=\"" << y(shape.points[i])
          << "\" stroke=\"blue\" stroke-dasharray=\"2 4\"/>\n";
    for (const auto& p : shape.points) dot(p, 4, "blue");
  }
  out << "</svg>\n";
}

/// Settings that all runs have in common.
struct Setting {
  std::string world, ini_text;
  std::vector<std::string> world_settings, settings;
  std::string without_search;  // the setting that turns the search off
};

/// Results of one log, which is mapped with the search, without the moved markers, and without the search.
struct Outcome {
  std::size_t moved = 0, in_both = 0, found = 0, found_of_others = 0, wrong = 0;
  double error = 0, without_moved = 0, not_found_out = 0;  // [m]
  double seconds = 0, search = 0;                          // [s]
};

Outcome runSeed(const Setting& setting, const Together& together, std::size_t seed, const std::string& svg) {
  auto config = base::Config::fromFile(setting.world);
  config.set("simulation.seed=" + std::to_string(seed));
  for (const auto& one : setting.world_settings) config.set(one);
  const Drive drive(config, together, seed);
  const auto engine = omnimapper::testing::makeEngine(setting.ini_text, setting.settings);
  const auto start = std::chrono::steady_clock::now();
  omnimapper::testing::run(*engine, drive.observations);
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto view = engine->view();
  const auto moved = drive.moved(), both = drive.movedAndSeenInBoth(view), found = foundMoved(view);
  outcome.moved = moved.size();
  outcome.in_both = both.size();
  outcome.found = countOf(both, found);
  outcome.found_of_others = countOf(moved, found) - outcome.found;
  outcome.wrong = found.size() - countOf(moved, found);
  auto no_search = setting.settings;
  no_search.push_back(setting.without_search);
  const auto without = omnimapper::testing::makeEngine(setting.ini_text, no_search),
             spoiled = omnimapper::testing::makeEngine(setting.ini_text, no_search);
  omnimapper::testing::run(*without, withoutNumbers(drive.observations, moved));
  omnimapper::testing::run(*spoiled, drive.observations);
  outcome.error = drive.trajectoryError(view);
  outcome.without_moved = drive.trajectoryError(without->view());
  outcome.not_found_out = drive.trajectoryError(spoiled->view());
  const auto& totals = view.times.totals();
  if (const auto stage = totals.find("plugin moveables"); stage != totals.end()) outcome.search = stage->second.seconds;
  if (!svg.empty()) draw(view, svg);
  return outcome;
}

/// Results of many runs: sums of counts, and means of errors and times.
struct Statistics {
  Outcome sum;
  std::size_t within = 0, runs = 0;
  double worst_ratio = 0, sum_of_ratios = 0;

  void add(const Outcome& one) {
    ++runs;
    for (const auto count :
         {&Outcome::moved, &Outcome::in_both, &Outcome::found, &Outcome::found_of_others, &Outcome::wrong})
      sum.*count += one.*count;
    for (const auto value :
         {&Outcome::error, &Outcome::without_moved, &Outcome::not_found_out, &Outcome::seconds, &Outcome::search})
      sum.*value += one.*value;
    const double ratio = one.error / one.without_moved;
    within += ratio <= 1.1;
    worst_ratio = std::max(worst_ratio, ratio);
    sum_of_ratios += ratio;
  }
  double mean(double Outcome::*value) const { return sum.*value / static_cast<double>(runs); }
};

// The experiment of thesis 4.6.3.
void carriedAway(const Setting& setting, std::size_t first, std::size_t seeds, const std::string& svg) {
  std::printf(
      "| seed | moved | seen in both | found of these | of others | false | error [m] | without the moved [m] | "
      "without this plugin [m] | time [s] | search alone [s] |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  Statistics statistics;
  for (std::size_t seed = first; seed < first + seeds; ++seed) {
    const Outcome one = runSeed(setting, {}, seed, seed == first ? svg : "");
    std::printf("| %zu | %zu | %zu | %zu | %zu | %zu | %.4f | %.4f | %.4f | %.2f | %.3f |\n", seed, one.moved,
                one.in_both, one.found, one.found_of_others, one.wrong, one.error, one.without_moved, one.not_found_out,
                one.seconds, one.search);
    std::fflush(stdout);
    statistics.add(one);
  }
  std::printf(
      "\nfound %zu of %zu that were seen in both places, %zu false; error %.4f m, without the moved %.4f m, not found "
      "out %.4f m; search %.2f s of %.2f s\nratio of the error to that without the moved ones: of the means %.3f, mean "
      "of the runs %.3f, worst %.3f, at most 1.1 in %zu of %zu\n",
      statistics.sum.found, statistics.sum.in_both, statistics.sum.wrong, statistics.mean(&Outcome::error),
      statistics.mean(&Outcome::without_moved), statistics.mean(&Outcome::not_found_out),
      statistics.mean(&Outcome::search), statistics.mean(&Outcome::seconds),
      statistics.sum.error / statistics.sum.without_moved, statistics.sum_of_ratios / static_cast<double>(seeds),
      statistics.worst_ratio, statistics.within, seeds);
}

// The experiment of thesis 4.6.4.
void movedTogether(const Setting& setting, const std::vector<double>& shares, std::size_t first, std::size_t seeds) {
  std::printf(
      "| share | moved | seen in both | found of these | false | error [m] | without the moved [m] | not found out "
      "[m] |\n|---|---|---|---|---|---|---|---|\n");
  for (const double share : shares) {
    Statistics statistics;
    Together together;
    together.share = share;
    for (std::size_t seed = first; seed < first + seeds; ++seed) statistics.add(runSeed(setting, together, seed, ""));
    std::printf("| %.0f %% | %zu | %zu | %zu | %zu | %.3f | %.3f | %.3f |\n", 100 * share, statistics.sum.moved,
                statistics.sum.in_both, statistics.sum.found, statistics.sum.wrong, statistics.mean(&Outcome::error),
                statistics.mean(&Outcome::without_moved), statistics.mean(&Outcome::not_found_out));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Counts detected moves of markers and measures the trajectory error over seeds.");
  Setting setting{omnimapper::testing::sourceFile("rawlogs/two_offices.ini"), {}, {}, {}, {}};
  std::string mapping = omnimapper::testing::sourceFile("ini/moveables.ini"), svg;
  std::size_t seeds = 5, first = 1;
  std::vector<double> shares;
  bool laser = false;
  app.add_option("--world", setting.world, "INI of the simulator")->capture_default_str();
  app.add_option("--ini", mapping, "INI of the mapper")->capture_default_str();
  app.add_option("--seeds", seeds, "number of seeds")->capture_default_str();
  app.add_option("--first", first, "first seed")->capture_default_str();
  app.add_option("--simulate", setting.world_settings, "section.key=value for the simulator; may be repeated");
  app.add_option("--set", setting.settings, "section.key=value for the mapper; may be repeated");
  app.add_option("--together", shares, "shares of the markers that move together, each from 0 to 1");
  app.add_flag("--laser", laser, "add a laser, which measures the motion and whose walls are landmarks");
  app.add_option("--svg", svg, "file for a drawing of the map of the first seed");
  CLI11_PARSE(app, argc, argv);

  std::ifstream file(mapping);
  setting.ini_text = {std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> simulate = {std::string("simulation.sensors=") +
                                       (laser ? "laser,markers,odometry" : "markers,odometry")};
  if (!shares.empty()) simulate.push_back("world.move_time_s=-1");
  setting.world_settings.insert(setting.world_settings.begin(), simulate.begin(), simulate.end());
  setting.without_search = std::string("mapper.measurement_plugins=") + (laser ? "walls,points" : "points");
  if (laser) {
    const std::vector<std::string> with_laser = {"mapper.pose_plugins=scan_odometry,odometry,no_motion",
                                                 "mapper.measurement_plugins=walls,points,moveables",
                                                 "perception.extractors=laser_points,laser_lines",
                                                 "scan_odometry.class=ScanOdometryPlugin",
                                                 "odometry.fallback=true",
                                                 "laser_points.class=LaserPointsExtractor",
                                                 "laser_lines.class=LaserLineExtractor",
                                                 "walls.class=PlaneLandmarksPlugin",
                                                 "walls.form=wall"};
    setting.settings.insert(setting.settings.begin(), with_laser.begin(), with_laser.end());
  }
  if (shares.empty()) {
    carriedAway(setting, first, seeds, svg);
  } else {
    movedTogether(setting, shares, first, seeds);
  }
}
