// Laser and wheel odometry of the simulator beside those of recordings: noise on walls and of a robot that stands,
// beams without echo, mixed pixels at edges, drift of odometry. Prints Markdown tables and writes SVG plots.
//
// Example: bench-simulator_noise_laser --data ../shared/data/laser2d -o doc/results
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim/Sensor.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/RawlogSource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include "../sim/SmallWorlds.h"
#include "LaserFigures.h"
#include "LinePlot.h"

namespace {

using namespace omnimapper;
using bench::Curve;
using bench::LaserFigures;
using geometry::Se2;

/// A log as this program needs it: scans are counted while it is read, odometry is kept.
struct Recording {
  std::string name, colour;
  LaserFigures laser;
  std::map<base::Stamp, Se2> odometry;
};

void take(Recording& recording, const mrpt::obs::CObservation& observation, std::optional<Se2>& at_scan) {
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    recording.odometry.emplace(odometry->timestamp, geometry::fromMrpt(odometry->odometry));
  } else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
    const std::optional<Se2> now =
        recording.odometry.empty() ? std::nullopt : std::make_optional(recording.odometry.rbegin()->second);
    const bool stands = now && at_scan && geometry::minus(*now, *at_scan).norm() < 1e-4;
    recording.laser.add(*scan, stands);
    at_scan = now;
  }
}

// Readings from `farthest` on are no echo [m].
Recording read(source::ObservationSource& source, const std::string& name, const std::string& colour,
               double farthest = 1e9) {
  Recording recording{name, colour, LaserFigures(farthest), {}};
  std::optional<Se2> at_scan;
  while (const auto observation = source.next()) take(recording, *observation, at_scan);
  return recording;
}

/// A corridor with offices on both sides: boxes, chairs' legs, dark boards, a glazed door.
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

/// A run of the simulator with the laser and the odometry of these keys.
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
    Recording recording{name, colour, LaserFigures(), {}};
    std::optional<Se2> at_scan;
    int next = 0;
    for (int k = 0; k < laser->count(); ++k) {
      for (; next < odometry->count() && odometry->timeOf(next) <= laser->timeOf(k); ++next)
        take(recording, *odometry->measure(next).observation, at_scan);
      take(recording, *laser->measure(k).observation, at_scan);
    }
    return recording;
  }
  std::map<base::Stamp, Se2> truth() const {
    std::map<base::Stamp, Se2> poses;
    for (double time = 0; time < track_.places().back().time; time += 0.5)
      poses.emplace(base::stampFromUnix(1e9) + base::durationFromSeconds(time), geometry::project(*track_.at(time)));
    return poses;
  }

 private:
  std::uint64_t seed_;
  sim::World world_;
  sim::Scenes scenes_;
  sim::Track track_;
};

/// Errors of odometry over stretches of this way: of the end's place and heading, root mean squares.
struct Drift {
  std::vector<std::pair<double, double>> place, heading, mean_heading;  // over the way [m]: [m], [deg], [deg]
};

const std::vector<double> kWays{1, 2, 4, 8, 16, 24};

struct DriftSums {
  std::map<double, std::array<double, 4>> of_way;  // squares of place and heading, count, sum of heading
  void add(const std::map<base::Stamp, Se2>& odometry, const std::map<base::Stamp, Se2>& truth) {
    std::vector<std::pair<Se2, Se2>> both;  // odometry, truth
    std::vector<double> way{0};
    for (const auto& [stamp, pose] : truth) {
      const auto after = odometry.lower_bound(stamp);
      if (after == odometry.begin() || after == odometry.end()) continue;
      const auto before = std::prev(after);
      const double span = base::secondsBetween(before->first, after->first);
      if (span > 1) continue;
      const double share = base::secondsBetween(before->first, stamp) / span;
      both.emplace_back(geometry::plus(before->second, share * geometry::minus(after->second, before->second)), pose);
      if (both.size() > 1)
        way.push_back(way.back() +
                      (both.back().first.translation() - both[both.size() - 2].first.translation()).norm());
    }
    for (const double length : kWays) {
      for (std::size_t i = 0, j = 0; i < both.size(); ++i) {
        while (j < both.size() && way[j] - way[i] < length) ++j;
        if (j == both.size()) break;
        if (way[j] - way[i] > 1.5 * length) continue;
        const Eigen::Vector3d error = geometry::minus(geometry::inverse(both[i].first) * both[j].first,
                                                      geometry::inverse(both[i].second) * both[j].second);
        auto& sums = of_way[length];
        sums[0] += error.head<2>().squaredNorm(), sums[1] += error.z() * error.z(), ++sums[2];
        sums[3] += error.z();
      }
    }
  }
  Drift drift() const {
    Drift result;
    for (const auto& [length, sums] : of_way) {
      result.place.emplace_back(length, std::sqrt(sums[0] / sums[2]));
      result.heading.emplace_back(length, std::sqrt(sums[1] / sums[2]) * 180 / M_PI);
      result.mean_heading.emplace_back(length, sums[3] / sums[2] * 180 / M_PI);
    }
    return result;
  }
};

void writePlot(const std::string& path, const std::string& title, const std::string& x, const std::string& y,
               const std::vector<Curve>& curves) {
  std::ofstream out(path);
  bench::plotCurves(out, title, x, y, curves);
}

std::vector<Curve> noiseCurves(const std::vector<Recording>& all,
                               std::map<int, LaserFigures::Sum> LaserFigures::*sums) {
  std::vector<Curve> curves;
  for (const Recording& recording : all) {
    Curve curve{recording.name, recording.colour, {}};
    for (const auto& [bin, sum] : recording.laser.*sums) {
      if (sum.count > 300 && bin < 16)
        curve.points.emplace_back((bin + 0.5) * LaserFigures::kBin, 1000 * sum.deviation());
    }
    curves.push_back(curve);
  }
  return curves;
}

void writeLaser(const std::vector<Recording>& all, const std::string& folder) {
  const auto walls = noiseCurves(all, &LaserFigures::on_walls), repeated = noiseCurves(all, &LaserFigures::repeated);
  writePlot(folder + "/simulator_laser_walls.svg", "Residual of ranges to lines through walls", "range [m]",
            "standard deviation [mm]", walls);
  writePlot(folder + "/simulator_laser_repeated.svg", "Change of a beam while the robot stands, over root 2",
            "range [m]", "standard deviation [mm]", repeated);
  std::vector<Curve> edges;
  std::printf("| laser | beams without echo | mixed at edges of");
  for (std::size_t b = 0; b < 4; ++b)
    std::printf(" %.1f to %.1f m |", LaserFigures::kGaps[b], LaserFigures::kGaps[b + 1]);
  std::printf("\n|---|---|---|---|---|---|\n");
  for (const Recording& recording : all) {
    const LaserFigures& laser = recording.laser;
    Curve curve{recording.name, recording.colour, {}};
    std::printf("| %s | %.2f %% |", recording.name.c_str(), 100 * laser.no_echo / laser.beams);
    for (std::size_t b = 0; b < 4; ++b) {
      const double share = laser.edges[b] > 0 ? 100 * laser.mixed[b] / laser.edges[b] : 0;
      std::printf(" %.1f %% of %.0f |", share, laser.edges[b]);
      if (laser.edges[b] > 20)
        curve.points.emplace_back(0.5 * (LaserFigures::kGaps[b] + LaserFigures::kGaps[b + 1]), share);
    }
    std::printf("\n");
    edges.push_back(curve);
  }
  writePlot(folder + "/simulator_laser_edges.svg", "Edges with a point between their two sides",
            "depth of the edge [m]", "part [%]", edges);
  for (const auto* curves : {&walls, &repeated}) {
    std::printf("\n%s: range [m] and deviation [mm]\n", curves == &walls ? "On walls" : "Standing");
    for (const Curve& curve : *curves) {
      std::printf("| %s |", curve.name.c_str());
      for (const auto& [x, y] : curve.points) std::printf(" %.1f: %.1f |", x, y);
      std::printf("\n");
    }
  }
}

void writeOdometry(const Drift& recorded, const Drift& simulated, const std::string& folder) {
  writePlot(folder + "/simulator_odometry_place.svg", "Odometry: error of the place after a way", "way [m]",
            "root mean square [m]", {{"ACES", "#c0392b", recorded.place}, {"simulated", "#2471a3", simulated.place}});
  writePlot(folder + "/simulator_odometry_heading.svg", "Odometry: error of the heading after a way", "way [m]",
            "root mean square [deg]",
            {{"ACES", "#c0392b", recorded.heading}, {"simulated", "#2471a3", simulated.heading}});
  std::printf(
      "\n| way [m] | ACES place [m] | simulated | ACES heading [deg] | its mean | simulated "
      "|\n|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < std::min(recorded.place.size(), simulated.place.size()); ++i) {
    std::printf("| %.0f | %.3f | %.3f | %.2f | %.2f | %.2f |\n", recorded.place[i].first, recorded.place[i].second,
                simulated.place[i].second, recorded.heading[i].second, recorded.mean_heading[i].second,
                simulated.heading[i].second);
  }
}

void run(const std::string& data, const std::string& folder) {
  source::CarmenLog aces_log(data + "/aces.clf.bz2");
  source::RawlogSource ual_log(data + "/ual.rawlog"), office_log(data + "/driving_in_office.rawlog");
  std::vector<Recording> all;
  all.push_back(read(aces_log, "ACES, 5 cm", "#c0392b", 50));
  all.push_back(read(ual_log, "ual, 1 cm", "#8e44ad"));
  all.push_back(read(office_log, "driving_in_office, 1 mm", "#1e8449"));
  const Simulated simulated(1);
  all.push_back(simulated.record("model = sick_pls\nrate_hz = 5\n", "simulated sick_pls", "#e59866"));
  all.push_back(
      simulated.record("model = sick_lms291\nbeams = 361\nrate_hz = 5\n", "simulated sick_lms291", "#2471a3"));
  all.push_back(simulated.record("model = hokuyo_utm30\nrate_hz = 5\n", "simulated hokuyo_utm30", "#7dcea0"));
  writeLaser(all, folder);

  std::map<base::Stamp, Se2> reference;
  for (const auto& pose : eval::readTum(data + "/aces.reference.tum"))
    reference.emplace(pose.stamp, geometry::project(pose.world_from_body));
  DriftSums recorded, drawn;
  recorded.add(all[0].odometry, reference);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Simulated one(seed);
    std::map<base::Stamp, Se2> odometry;
    const auto sensor = one.sensor("class = Odometry\nrate_hz = 20\n", 2);
    for (int k = 0; k < sensor->count(); ++k) {
      const auto reading = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(sensor->measure(k).observation);
      odometry.emplace(reading->timestamp, geometry::fromMrpt(reading->odometry));
    }
    drawn.add(odometry, one.truth());
  }
  writeOdometry(recorded.drift(), drawn.drift(), folder);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Noise of the simulator's laser and odometry beside recordings");
  std::string data, folder = ".";
  app.add_option("--data", data, "Folder of aces.clf.bz2, aces.reference.tum, ual.rawlog and driving_in_office.rawlog")
      ->required();
  app.add_option("-o,--output", folder, "Folder of the plots");
  CLI11_PARSE(app, argc, argv);
  try {
    run(data, folder);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
