// Compares the simulator's 2D lasers with recordings: noise on walls and while the robot stands, beams without echo,
// and mixed pixels at edges. Prints Markdown tables and writes SVG plots.
//
// Example: bench-simulator_noise_laser --data ../shared/data/laser2d -o doc/results
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim/Sensor.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/openLogs.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <optional>

#include "../sim/SmallWorlds.h"
#include "CurvePlot.h"
#include "LaserMetrics.h"

namespace {

using namespace omnimapper;
using bench::LaserMetrics;
using bench::PlottedCurve;
using geometry::Se2;

/// Metrics of the laser of a log, which are collected while the log is read.
struct Recording {
  std::string name, colour;
  LaserMetrics laser;
  std::optional<Se2> odometry, at_scan;  // the latest odometry, and its value at the latest scan
};

void take(Recording& recording, const mrpt::obs::CObservation& observation) {
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    recording.odometry = geometry::fromMrpt(odometry->odometry);
  } else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
    const auto &now = recording.odometry, &before = recording.at_scan;
    recording.laser.add(*scan, now && before && geometry::minus(*now, *before).norm() < 1e-4);
    recording.at_scan = now;
  }
}

// Reads a log. Ranges of `farthest` [m] or more count as no echo.
Recording read(source::ObservationSource& source, const std::string& name, const std::string& colour,
               double farthest = 1e9) {
  Recording recording{name, colour, LaserMetrics(farthest), {}, {}};
  while (const auto observation = source.next()) take(recording, *observation);
  return recording;
}

/// A corridor with offices on both sides, with boxes, legs of chairs, dark boards and a glazed door.
sim::World office() {
  using namespace small_worlds;
  sim::World world;
  sim::Material paint, dark, glass;
  paint.infrared = 0.7f, dark.infrared = 0.06f;
  glass.infrared = 0.05f, glass.transmission = 0.95f;
  addRoom(world, "corridor", {0, 0}, {24, 2.2});
  addWall(world, "west", {0, 0}, {0, 2.2}, paint);
  addWall(world, "east_glass", {24, 2.2}, {24, 0}, glass);
  sim::Random random(5, {});
  for (int i = 0; i < 8; ++i) {
    const bool upper = i % 2 == 1;
    const double x = 6.0 * (i / 2), near = upper ? 2.2 : 0.0, far = upper ? 7.2 : -5.0,
                 door = x + 1 + 3 * random.uniform();
    const std::string name = "office_" + std::to_string(i);
    addRoom(world, name, {x, std::min(near, far)}, {x + 6, std::max(near, far)});
    addWall(world, name + "/door_left", {x, near}, {door, near}, paint);
    addWall(world, name + "/door_right", {door + 0.95, near}, {x + 6, near}, paint);
    addWall(world, name + "/back", {x, far}, {x + 6, far}, paint);
    addWall(world, name + "/left", {x, near}, {x, far}, paint);
    if (i >= 6) addWall(world, name + "/right", {x + 6, near}, {x + 6, far}, paint);
    for (int j = 0; j < 5; ++j) {
      const Eigen::Vector2d low(x + random.uniform(0.3, 5), std::min(near, far) + random.uniform(0.9, 4));
      const bool is_leg = j > 2;
      addBox(world, name + "/thing_" + std::to_string(j), low,
             low + (is_leg ? Eigen::Vector2d(0.04, 0.04)
                           : Eigen::Vector2d(random.uniform(0.2, 0.9), random.uniform(0.2, 0.6))),
             1, j == 0 ? dark : paint);
    }
  }
  return world;
}

/// Runs the simulator in the office with an odometry and a laser of the given keys.
class Simulated {
 public:
  explicit Simulated(std::uint64_t seed)
      : seed_(seed),
        world_(office()),
        scenes_(world_),
        track_(sim::planDrive(
            base::Config::fromText("[robot]\npause_s = 3\nlook_around_deg = 120\nradius_m = 0.25\n", "office"),
            world_)) {}

  std::unique_ptr<sim::Sensor> sensor(const std::string& keys, std::uint64_t number) const {
    sim::SensorContext context;
    context.seed = seed_, context.number = number;
    context.start = base::stampFromUnix(1e9);
    context.duration = track_.places().back().time;
    context.world = &world_, context.scenes = &scenes_, context.map_from_base = &track_;
    return sim::makeSensor(base::Config::fromText("[sensor]\n" + keys, "office"), "sensor", context);
  }
  Recording record(const std::string& laser_keys, const std::string& name, const std::string& colour) const {
    const auto laser = sensor("class = Laser2d\nz_m = 0.4\n" + laser_keys, 1);
    const auto odometry = sensor("class = Odometry\nrate_hz = 20\n", 2);
    Recording recording{name, colour, LaserMetrics(), {}, {}};
    int next = 0;
    for (int k = 0; k < laser->count(); ++k) {
      for (; next < odometry->count() && odometry->timeOf(next) <= laser->timeOf(k); ++next)
        take(recording, *odometry->measure(next).observation);
      take(recording, *laser->measure(k).observation);
    }
    return recording;
  }

 private:
  std::uint64_t seed_;
  sim::World world_;
  sim::Scenes scenes_;
  sim::Track track_;
};

std::vector<PlottedCurve> noiseCurves(const std::vector<Recording>& all,
                                      std::map<int, LaserMetrics::Sum> LaserMetrics::*sums) {
  std::vector<PlottedCurve> curves;
  for (const Recording& recording : all) {
    PlottedCurve curve{recording.name, recording.colour, {}};
    for (const auto& [bin, sum] : recording.laser.*sums) {
      if (sum.count > 300 && bin < 16)
        curve.points.emplace_back((bin + 0.5) * LaserMetrics::kBin, 1000 * sum.deviation());
    }
    curves.push_back(curve);
  }
  return curves;
}

void writeLaser(const std::vector<Recording>& all, const std::string& folder) {
  const auto walls = noiseCurves(all, &LaserMetrics::on_walls), repeated = noiseCurves(all, &LaserMetrics::repeated);
  bench::plotCurves(folder + "/simulator_laser_walls.svg", "Residual of ranges to lines through walls", "range [m]",
                    "standard deviation [mm]", walls);
  bench::plotCurves(folder + "/simulator_laser_repeated.svg", "Change of a beam while the robot stands, over root 2",
                    "range [m]", "standard deviation [mm]", repeated);
  std::vector<PlottedCurve> edges;
  std::printf("| laser | beams without echo | mixed at edges of");
  for (std::size_t b = 0; b < 4; ++b)
    std::printf(" %.1f to %.1f m |", LaserMetrics::kGaps[b], LaserMetrics::kGaps[b + 1]);
  std::printf("\n|---|---|---|---|---|---|\n");
  for (const Recording& recording : all) {
    const LaserMetrics& laser = recording.laser;
    PlottedCurve curve{recording.name, recording.colour, {}};
    std::printf("| %s | %.2f %% |", recording.name.c_str(), 100 * laser.no_echo / laser.beams);
    for (std::size_t b = 0; b < 4; ++b) {
      const double share = laser.edges[b] > 0 ? 100 * laser.mixed[b] / laser.edges[b] : 0;
      std::printf(" %.1f %% of %.0f |", share, laser.edges[b]);
      if (laser.edges[b] > 20)
        curve.points.emplace_back(0.5 * (LaserMetrics::kGaps[b] + LaserMetrics::kGaps[b + 1]), share);
    }
    std::printf("\n");
    edges.push_back(curve);
  }
  bench::plotCurves(folder + "/simulator_laser_edges.svg", "Edges with a point between their two sides",
                    "depth of the edge [m]", "part [%]", edges);
  for (const auto* curves : {&walls, &repeated}) {
    std::printf("\n%s: range [m] and deviation [mm]\n", curves == &walls ? "On walls" : "Standing");
    for (const PlottedCurve& curve : *curves) {
      std::printf("| %s |", curve.name.c_str());
      for (const auto& [x, y] : curve.points) std::printf(" %.1f: %.1f |", x, y);
      std::printf("\n");
    }
  }
}

void run(const std::string& data, const std::string& folder) {
  const auto aces_log = source::openLogs({data + "/aces.clf.bz2"}, {});
  source::RawlogSource ual_log(data + "/ual.rawlog"), office_log(data + "/driving_in_office.rawlog");
  std::vector<Recording> all;
  all.push_back(read(*aces_log, "ACES, 5 cm", "#c0392b", 50));
  all.push_back(read(ual_log, "ual, 1 cm", "#8e44ad"));
  all.push_back(read(office_log, "driving_in_office, 1 mm", "#1e8449"));
  const Simulated simulated(1);
  all.push_back(simulated.record("model = sick_pls\nrate_hz = 5\n", "simulated sick_pls", "#e59866"));
  all.push_back(
      simulated.record("model = sick_lms291\nbeams = 361\nrate_hz = 5\n", "simulated sick_lms291", "#2471a3"));
  all.push_back(simulated.record("model = hokuyo_utm30\nrate_hz = 5\n", "simulated hokuyo_utm30", "#7dcea0"));
  writeLaser(all, folder);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the noise of the simulator's lasers with recordings.");
  std::string data, folder = ".";
  app.add_option("--data", data, "Folder with aces.clf.bz2, ual.rawlog and driving_in_office.rawlog")->required();
  app.add_option("-o,--output", folder, "Folder for the plots");
  CLI11_PARSE(app, argc, argv);
  try {
    run(data, folder);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
