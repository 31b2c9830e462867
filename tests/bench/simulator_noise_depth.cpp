// Compares depths of recorded and simulated Kinects: noise, steps and holes, as plots and a table.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "CurvePlot.h"
#include "DepthStatistics.h"
#include "DeskScene.h"

namespace {

using namespace omnimapper;
using bench::Curve;
using bench::DepthStatistics;

struct Source {
  std::string name, colour;
  DepthStatistics statistics;
};

sim::Track around(const Eigen::Vector3d& eye, double pitch, double yaw_swing, double pitch_swing, double reach) {
  std::vector<sim::Track::Place> places;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.1 * i;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw_swing * std::sin(0.5 * t), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(pitch + pitch_swing * std::sin(0.7 * t), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(0.3 * std::sin(0.9 * t), Eigen::Vector3d::UnitX()));
    const Eigen::Vector3d moved(reach * std::sin(t), reach * std::cos(0.8 * t), 0.3 * reach * std::sin(1.1 * t));
    places.push_back({t, geometry::Se3{turn, eye + moved}});
  }
  return {sim::Track::Kind::motion, places};
}

void plotAll(const std::string& folder, const std::vector<Source>& sources) {
  struct Plot {
    std::string file, title, x, y;
    Curve DepthStatistics::*curve;
  };
  const std::vector<Plot> plots{
      {"noise", "Residual of local planes, flattest quarter", "distance [m]", "mm", &DepthStatistics::noise},
      {"step", "Steps between depths that occur", "distance [m]", "mm", &DepthStatistics::step},
      {"gap_shadow", "Hole where the disparity rises to the right (shadow)", "disparity step [pixel]", "pixels",
       &DepthStatistics::shadow_gap},
      {"gap_lit", "Hole where the disparity falls to the right", "disparity step [pixel]", "pixels",
       &DepthStatistics::lit_gap},
      {"angle", "Missing on flat patches", "incidence [deg]", "%", &DepthStatistics::missing_at_angle}};
  for (const Plot& plot : plots) {
    std::vector<bench::PlottedCurve> curves;
    for (const Source& source : sources) {
      const Curve& curve = source.statistics.*plot.curve;
      curves.push_back({source.name, source.colour, {curve.begin(), curve.end()}});
    }
    bench::plotCurves(folder + "/simulator_depth_" + plot.file + ".svg", plot.title, plot.x, plot.y, curves);
  }
}

void printRow(const Source& source) {
  const DepthStatistics& s = source.statistics;
  const auto at = [](const Curve& curve, double x) {
    const auto found = curve.find(x);
    char text[16] = "-";
    if (found != curve.end()) std::snprintf(text, sizeof text, "%.1f", found->second);
    return std::string(text);
  };
  std::cout << "| " << source.name;
  for (const double x : {0.875, 1.125, 1.625, 2.125, 3.125}) std::cout << " | " << at(s.noise, x);
  for (const double x : {1.125, 2.125, 3.125}) std::cout << " | " << at(s.step, x);
  for (const double x : {5.0, 11.0}) std::cout << " | " << at(s.shadow_gap, x) << " / " << at(s.lit_gap, x);
  for (const double x : {25.0, 65.0, 75.0}) std::cout << " | " << at(s.missing_at_angle, x);
  char text[64];
  std::snprintf(text, sizeof text, " | %.1f | %.2f %.2f %.2f %.2f |\n", s.missing, s.correlation[0], s.correlation[1],
                s.correlation[2], s.correlation[3]);
  std::cout << text;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares simulated depth with recordings: noise, steps, holes.");
  std::string rpy, desk, clouds, plots, keys;
  int frames = 20;
  app.add_option("--rpy", rpy, "Folder of TUM freiburg1_rpy");
  app.add_option("--desk", desk, "Folder of TUM freiburg1_desk");
  app.add_option("--clouds", clouds, "Folder of the object data set's clouds");
  app.add_option("--frames", frames, "Simulated frames of each scene");
  app.add_option("--plots", plots, "Folder for SVG plots");
  app.add_option("--keys", keys, "Keys of the simulated sensor, separated by ';', for trying other parameters");
  CLI11_PARSE(app, argc, argv);
  std::replace(keys.begin(), keys.end(), ';', '\n');
  std::vector<Source> sources;
  if (!rpy.empty()) sources.push_back({"TUM fr1 rpy", "#1f4e9c", bench::statistics(bench::readTum(rpy, 15))});
  if (!desk.empty()) sources.push_back({"TUM fr1 desk", "#5fa8e0", bench::statistics(bench::readTum(desk, 1))});
  if (!clouds.empty()) sources.push_back({"object clouds", "#2e8b57", bench::statistics(bench::readClouds(clouds))});
  const auto office = bench::DeskScene::office(), table = bench::DeskScene::tableTop();
  const std::string kinect = "model = kinect\ncolour = false\n" + keys + "\n";
  sources.push_back(
      {"simulated office", "#d62728",
       bench::statistics(bench::simulate(office, around({0.3, 0.1, 1.35}, 0.45, 0.6, 0.35, 0.2), kinect, frames))});
  sources.push_back(
      {"simulated table", "#ff9f40",
       bench::statistics(bench::simulate(table, around({0.1, 0, 1.35}, 0.7, 0.1, 0.08, 0.15), kinect, frames))});
  std::cout
      << "| source | noise [mm] at 0.9 m | 1.1 | 1.6 | 2.1 | 3.1 | step [mm] at 1.1 m | 2.1 | 3.1 | hole at a step "
         "of 5 pixels, shadow / lit side | of 11 | missing [%] at 25 deg | 65 | 75 | in all | correlation 1, 2, 4, 8 "
         "pixels apart |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Source& source : sources) printRow(source);
  if (!plots.empty()) plotAll(plots, sources);
  return 0;
}
