// Things that were moved while the robot was elsewhere (thesis 4.6.3): how many of them are found out, how many are
// taken for moved that were not, and what it does to the trajectory, over worlds and drives of many seeds. Prints a
// Markdown table, and draws one of the maps.
//
// Example: bench-moveable_things --seeds 50 --svg doc/results/moveable_things.svg
#include <mrpt/obs/CObservationBearingRange.h>
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
#include <set>

#include "landmarks/MovedThingPayload.h"
#include "landmarks/PointPayload.h"

namespace {

using namespace omnimapper;
using mrpt::obs::CObservationBearingRange;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

/// A drive with what is true of it.
struct Drive {
  sim::Simulation simulation;
  Observations observations;

  explicit Drive(const base::Config& config) : simulation(config) {
    std::multimap<double, mrpt::obs::CObservation::Ptr> in_order;
    for (const auto& sensor : simulation.sensors()) {
      for (int k = 0; k < sensor->count(); ++k) {
        if (auto observation = sensor->measure(k).observation) in_order.emplace(sensor->arrivalOf(k), observation);
      }
    }
    for (const auto& [time, observation] : in_order) observations.push_back(observation);
  }
  double secondsAt(base::Stamp stamp) const { return base::secondsBetween(simulation.start(), stamp); }
  /// Where a landmark was [m, frame of the world].
  Eigen::Vector3d placeOf(const sim::PointLandmark& point, double time) const {
    for (const auto& body : simulation.world().bodies)
      if (body.name == point.body) return *body.track.at(std::max(time, 0.0)) * point.in_body;
    return point.in_body;
  }
  /// Numbers of those that are at the end elsewhere than at the start.
  std::set<int> moved() const {
    std::set<int> numbers;
    for (const auto& point : simulation.world().point_landmarks)
      if ((placeOf(point, 0) - placeOf(point, simulation.duration())).norm() > 0.01) numbers.insert(point.id);
    return numbers;
  }
  /// Moved ones that key frames of `view` saw at least twice in each of two places.
  std::set<int> movedAndSeenInBoth(const mapper::View& view) const {
    std::map<int, std::map<bool, int>> sightings;
    std::map<int, const sim::PointLandmark*> points;
    for (const auto& point : simulation.world().point_landmarks) points[point.id] = &point;
    for (const auto& frame : view.map.key_frames) {
      for (const auto& observation : frame.observations) {
        const auto* seen = dynamic_cast<const CObservationBearingRange*>(observation.get());
        if (!seen) continue;
        for (const auto& one : seen->sensedData) {
          const auto& point = *points.at(one.landmarkID);
          const bool at_first = (placeOf(point, secondsAt(frame.stamp)) - placeOf(point, 0)).norm() < 0.01;
          ++sightings[one.landmarkID][at_first];
        }
      }
    }
    std::set<int> both;
    for (const int number : moved())
      if (sightings[number][true] > 1 && sightings[number][false] > 1) both.insert(number);
    return both;
  }
  /// Root mean square over key frames, seen from the first of them [m].
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
    const auto* seen = dynamic_cast<const CObservationBearingRange*>(observation.get());
    if (!seen) {
      kept.push_back(observation);
      continue;
    }
    auto copy = std::make_shared<CObservationBearingRange>(*seen);
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

// Poses red, landmarks green, moved things blue with dotted lines, as Figure 49 of the thesis.
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
    for (const auto& [from, to] : shape.lines)
      out << "<line x1=\"" << x(from) << "\" y1=\"" << y(from) << "\" x2=\"" << x(to) << "\" y2=\"" << y(to)
          << "\" stroke=\"blue\" stroke-dasharray=\"2 4\"/>\n";
    for (const auto& p : shape.points) dot(p, 4, "blue");
  }
  out << "</svg>\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Things that were moved, found out: counts and trajectory error over seeds.");
  std::string world = omnimapper::testing::sourceFile("rawlogs/two_offices.ini"),
              mapping = omnimapper::testing::sourceFile("ini/moveables.ini");
  std::string svg;
  std::vector<std::string> world_settings, settings;
  std::size_t seeds = 5, first = 1;
  app.add_option("--world", world, "INI of the simulator")->capture_default_str();
  app.add_option("--ini", mapping, "INI of the mapper")->capture_default_str();
  app.add_option("--seeds", seeds, "how many")->capture_default_str();
  app.add_option("--first", first, "the first of them")->capture_default_str();
  app.add_option("--simulate", world_settings, "section.key=value for the simulator; may be repeated");
  app.add_option("--set", settings, "section.key=value for the mapper; may be repeated");
  app.add_option("--svg", svg, "draws the map of the first seed");
  CLI11_PARSE(app, argc, argv);

  std::ifstream file(mapping);
  const std::string ini((std::istreambuf_iterator<char>(file)), {});
  std::printf(
      "| seed | moved | seen in both | found of these | of others | false | error [m] | without the moved [m] | "
      "moved not found out [m] | time [s] | of it the search [s] |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::size_t all_both = 0, all_found = 0, all_false = 0, within = 0;
  double worst_ratio = 0, sum_ratio = 0;
  for (std::size_t seed = first; seed < first + seeds; ++seed) {
    auto config = base::Config::fromFile(world);
    config.set("simulation.seed=" + std::to_string(seed));
    for (const auto& setting : world_settings) config.set(setting);
    const Drive drive(config);
    const auto engine = omnimapper::testing::makeEngine(ini, settings);
    const auto start = std::chrono::steady_clock::now();
    omnimapper::testing::run(*engine, drive.observations);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto view = engine->view();
    const auto moved = drive.moved(), both = drive.movedAndSeenInBoth(view), found = foundMoved(view);
    auto more = settings;
    more.push_back("mapper.measurement_plugins=points");
    const auto without = omnimapper::testing::makeEngine(ini, more),
               spoiled = omnimapper::testing::makeEngine(ini, more);
    omnimapper::testing::run(*without, withoutNumbers(drive.observations, moved));
    omnimapper::testing::run(*spoiled, drive.observations);
    const double error = drive.trajectoryError(view), best = drive.trajectoryError(without->view());
    double search = 0;
    if (const auto found_stage = view.times.totals().find("plugin moveables"); found_stage != view.times.totals().end())
      search = found_stage->second.seconds;
    std::printf("| %zu | %zu | %zu | %zu | %zu | %zu | %.4f | %.4f | %.4f | %.2f | %.3f |\n", seed, moved.size(),
                both.size(), countOf(both, found), countOf(moved, found) - countOf(both, found),
                found.size() - countOf(moved, found), error, best, drive.trajectoryError(spoiled->view()), seconds,
                search);
    std::fflush(stdout);
    all_both += both.size();
    all_found += countOf(both, found);
    all_false += found.size() - countOf(moved, found);
    within += error <= 1.1 * best;
    worst_ratio = std::max(worst_ratio, error / best);
    sum_ratio += error / best / static_cast<double>(seeds);
    if (!svg.empty() && seed == first) draw(view, svg);
  }
  std::printf(
      "\nfound %zu of %zu that were seen in both places, %zu false; error over that without the moved ones: "
      "mean %.3f, worst %.3f, within 1.1 in %zu of %zu\n",
      all_found, all_both, all_false, sum_ratio, worst_ratio, within, seeds);
}
