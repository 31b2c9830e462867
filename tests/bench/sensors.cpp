// How laser and camera each contribute to a map of planes (thesis 5.5.2). Simulated places are mapped by wheel odometry
// with the lines of the laser, the planes of the camera, and both, and by scan matching alone. Prints the errors of
// trajectories and the number of landmarks by the sensors that measured them as Markdown, and draws figures 64 and 65.
// doc/results/planes.md shows both.
//
//   bench-sensors --simulated out/home out/office out/laboratory -o out/sensors --svg doc/results/sensors.svg
#include <omnimapper/draw/Svg.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/testing/Fixtures.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>

#include "SimulatedRun.h"
#include "planes/PlanePayload.h"

namespace {

using namespace omnimapper;

struct Setup {
  std::string out, landmarks_ini = omnimapper::testing::sourceFile("ini/home_planes.ini"),
                   scans_ini = omnimapper::testing::sourceFile("ini/laser2d.ini");
  int threads = 1;
};

struct Counts {
  std::size_t laser = 0, camera = 0, both = 0;
};

/// Data of figures 64 and 65 for one place.
struct PlaceMetrics {
  std::string name;
  std::vector<Eigen::Vector2d> lines, planes;  ///< x: number of a key frame, y: number of matches in it
  std::size_t key_frames = 0;
  Counts landmarks;
};

const std::map<std::string, std::vector<std::string>> kSensors = {
    {"laser", {"plane_landmarks.planes=false", "perception.extractors=laser_lines"}},
    {"camera", {"plane_landmarks.lines=false", "perception.extractors=planes,laser_points"}},
    {"both", {"perception.extractors=planes,laser_lines"}}};

bench::SimulatedRun mapWith(const Setup& setup, const bench::SimulatedPlace& place, const std::string& sensors) {
  std::vector<std::string> settings = {"mapper.pose_plugins=odometry,no_motion", "odometry.fallback=false",
                                       "mapper.measurement_plugins=plane_landmarks", "mapper.reference_sensor=laser"};
  const auto& own = kSensors.at(sensors);
  settings.insert(settings.end(), own.begin(), own.end());
  return bench::mapSimulated(place, setup.landmarks_ini, settings, setup.out + "/" + place.name() + "_" + sensors,
                             setup.threads);
}

Counts countBySensor(const map::Map& map) {
  Counts counts;
  for (const auto& [id, landmark] : map.landmarks) {
    if (landmark.state != map::Landmark::State::active) continue;
    bool by_line = false, by_plane = false;
    for (const auto& [label, count] : dynamic_cast<const plugins::PlanePayload&>(*landmark.payload).seen_by) {
      by_line |= count.lines > 0;
      by_plane |= count.planes > 0;
    }
    ++(by_line && by_plane ? counts.both : by_line ? counts.laser : counts.camera);
  }
  return counts;
}

// Mean number of matches in each block of ten key frames that have an observation of that class.
template <class Observation>
std::vector<Eigen::Vector2d> matchedByFrame(const derived::SavedMap& saved, const std::string& kind) {
  constexpr int kBlock = 10;
  std::vector<Eigen::Vector2d> means;
  Eigen::Vector2d sum(0, 0);
  double number = 0;
  int in_block = 0;
  for (const auto& frame : saved.map.key_frames) {
    ++number;
    const auto& observations = frame.observations;
    if (std::none_of(observations.begin(), observations.end(), [](const auto& o) { return IS_CLASS(*o, Observation); }))
      continue;
    const auto& factors = saved.graph.factorsOf(frame.pose);
    sum += Eigen::Vector2d(number, std::count_if(factors.begin(), factors.end(), [&](base::FactorId id) {
                             return saved.graph.factor(id).factor->kind() == kind;
                           }));
    if (++in_block < kBlock) continue;
    means.emplace_back(sum / kBlock);
    sum.setZero();
    in_block = 0;
  }
  return means;
}

PlaceMetrics printRow(const Setup& setup, const bench::SimulatedPlace& place) {
  const auto scans =
      bench::mapSimulated(place, setup.scans_ini, {}, setup.out + "/" + place.name() + "_scans", setup.threads);
  std::printf("| %s | %.4f m |", place.name().c_str(), scans.error.rmse);
  for (const std::string sensors : {"laser", "camera"})
    std::printf(" %.4f m |", mapWith(setup, place, sensors).error.rmse);
  const auto both = mapWith(setup, place, "both");
  const Counts counts = countBySensor(both.saved.map);
  std::printf(" %.4f m | %zu, %zu, %zu |\n", both.error.rmse, counts.laser, counts.camera, counts.both);
  std::fflush(stdout);
  return {place.name(), matchedByFrame<obs::CObservationLaserLines>(both.saved, "line_on_plane"),
          matchedByFrame<obs::CObservationPlanes>(both.saved, "plane_from_se3"), both.saved.map.key_frames.size(),
          counts};
}

constexpr double kLeft = 50, kColumn = 340, kSide = 270, kHeight = 190;
const std::string kLaser = "#2471a3", kCamera = "#c0392b", kBoth = "#7d3c98";

void drawMatched(draw::Svg& svg, double left, const PlaceMetrics& metrics) {
  double most = 1;
  for (const auto* curve : {&metrics.lines, &metrics.planes})
    for (const auto& point : *curve) most = std::max(most, point.y());
  const draw::Axes axes({left, 50}, {kSide, kHeight}, {0, 0}, {static_cast<double>(metrics.key_frames), most});
  axes.draw(svg, "key frame", "per key frame");
  svg.text({left + kSide / 2, 30}, metrics.name, draw::Svg::Anchor::middle, 14);
  const auto drawCurve = [&](const std::vector<Eigen::Vector2d>& curve, const std::string& colour) {
    std::vector<Eigen::Vector2d> pixels;
    for (const auto& point : curve) pixels.push_back(axes.pixel(point));
    svg.polyline(pixels, colour, 1.5);
  };
  drawCurve(metrics.lines, kLaser);
  drawCurve(metrics.planes, kCamera);
}

void drawLandmarks(draw::Svg& svg, double left, const Counts& counts) {
  const std::vector<std::tuple<std::string, std::size_t, std::string>> bars = {
      {"laser", counts.laser, kLaser}, {"camera", counts.camera, kCamera}, {"both", counts.both, kBoth}};
  const double most = static_cast<double>(std::max({counts.laser, counts.camera, counts.both, std::size_t{1}}));
  constexpr double kBottom = 500, kTallest = 170, kWidth = 60;
  double x = left + 20;
  for (const auto& [name, count, colour] : bars) {
    const double height = kTallest * static_cast<double>(count) / most;
    svg.box({x, kBottom - height}, {kWidth, height}, colour);
    svg.text({x + kWidth / 2, kBottom - height - 5}, std::to_string(count), draw::Svg::Anchor::middle);
    svg.text({x + kWidth / 2, kBottom + 16}, name, draw::Svg::Anchor::middle);
    x += kWidth + 20;
  }
}

void drawMetrics(const std::string& path, const std::vector<PlaceMetrics>& all) {
  std::ofstream out(path);
  draw::Svg svg(out, kLeft + kColumn * static_cast<double>(all.size()), 560);
  double left = kLeft;
  for (const PlaceMetrics& metrics : all) {
    drawMatched(svg, left, metrics);
    drawLandmarks(svg, left, metrics.landmarks);
    left += kColumn;
  }
  svg.text({kLeft, 545},
           "above: lines of the laser (blue) and planes of the camera (red) that were matched in a key frame, means of "
           "ten; below: landmarks by the sensors that measured them",
           draw::Svg::Anchor::start);
}

}  // namespace

int main(int argc, char** argv) {
  Setup setup;
  std::vector<std::string> folders;
  std::string svg;
  CLI::App app("Evaluates how laser and camera each contribute to a map of planes, in simulated places.");
  app.add_option("--simulated", folders, "folders that omnimapper-simulate wrote")->required();
  app.add_option("-o,--output", setup.out, "folder for the maps")->required();
  app.add_option("--svg", svg, "file for figures 64 and 65 of the thesis");
  app.add_option("--ini", setup.landmarks_ini, "INI of the maps of planes")->capture_default_str();
  app.add_option("--scans", setup.scans_ini, "INI of scan matching alone")->capture_default_str();
  app.add_option("--threads", setup.threads);
  CLI11_PARSE(app, argc, argv);
  omnimapper::mapper::loadFeatures();
  std::printf(
      "| place | scan matching alone | laser lines | camera planes | both | landmarks: laser, camera, both |\n"
      "|---|---|---|---|---|---|\n");
  std::vector<PlaceMetrics> metrics;
  for (const auto& folder : folders) metrics.push_back(printRow(setup, {folder}));
  if (!svg.empty()) drawMetrics(svg, metrics);
}
