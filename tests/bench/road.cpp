// The ground that a stereo camera sees of a simulated road, against the truth: which of the measured pixels of roads
// and pavements are found, and which others are taken for ground. Prints a Markdown table. Times are those of the
// processor, of one thread.
//
// Example: bench-road --ini rawlogs/road.ini --sensor stereo --frames 40
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/perception/RoadSegmenter.h>
#include <omnimapper/sim/Simulation.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "Timing.h"

namespace {

using namespace omnimapper;

struct Count {
  double all = 0, sure = 0, accepted = 0;
};

struct Counts {
  std::map<sim::SurfaceKind, Count> of_kind;
  std::vector<double> times;
};

// What surfaces are, by label.
std::vector<sim::SurfaceKind> kindsOf(const sim::World& world) {
  std::vector<sim::SurfaceKind> kinds{sim::SurfaceKind::clutter};
  for (const auto& ref : sim::numberSurfaces(world)) {
    kinds.push_back(
        world.bodies[static_cast<std::size_t>(ref.body)].surfaces[static_cast<std::size_t>(ref.surface)].kind);
  }
  return kinds;
}

void count(const sim::Measurement& measurement, const std::vector<sim::SurfaceKind>& kinds,
           const perception::RoadOptions& options, Counts& counts) {
  const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*measurement.observation);
  const std::string& png = measurement.truth_files.at(0).bytes;
  const cv::Mat names = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);
  const auto& c = scan.cameraParams;
  const perception::DepthImage image(scan.rangeImage.data(), static_cast<double>(scan.rangeUnits),
                                     static_cast<int>(c.ncols), static_cast<int>(c.nrows),
                                     {c.fx(), c.fy(), c.cx(), c.cy()});
  const double begin = processorTime();
  const auto found = perception::RoadSegmenter(options).segment(image, perception::expectedGround(scan, 0));
  counts.times.push_back(processorTime() - begin);
  for (std::size_t i = 0; i < found.sure.size(); ++i) {
    const double depth = scan.rangeImage.data()[i] * static_cast<double>(scan.rangeUnits);
    if (!(depth >= options.min_depth && depth <= options.max_depth)) continue;
    Count& of_kind = counts.of_kind[kinds[names.at<std::uint16_t>(static_cast<int>(i))]];
    ++of_kind.all;
    of_kind.sure += found.sure[i];
    of_kind.accepted += found.ground.labels[i] != 0;
  }
}

bool isGround(sim::SurfaceKind kind) {
  return kind == sim::SurfaceKind::road || kind == sim::SurfaceKind::floor;
}

Count operator+(const Count& a, const Count& b) {
  return {a.all + b.all, a.sure + b.sure, a.accepted + b.accepted};
}

void print(const std::string& name, const Count& count) {
  std::printf("| %s | %.0f | %.1f %% | %.1f %% |\n", name.c_str(), count.all,
              100 * count.sure / std::max(1.0, count.all), 100 * count.accepted / std::max(1.0, count.all));
}

}  // namespace

int main(int argc, char** argv) {
  std::string ini = "rawlogs/road.ini", name = "stereo";
  std::vector<std::string> settings;
  int frames = 40;
  perception::RoadOptions options;
  CLI::App app("The ground that a stereo camera sees of a simulated road.");
  app.add_option("--ini", ini, "simulated place");
  app.add_option("--set", settings, "section.key=value, over that INI");
  app.add_option("--sensor", name, "its RgbdCamera");
  app.add_option("--frames", frames, "how many of its frames")->check(CLI::PositiveNumber);
  app.add_option("--sigmas", options.grow_sigmas, "of the second pass");
  app.add_option("--tilt", options.max_tilt, "[rad] of the ground from the expected one");
  app.add_option("--slope", options.max_slope, "[rad] by which the expected range grows with the depth");
  app.add_option("--off", options.max_off, "[m] of the ground from the expected one");
  app.add_option("--pixels", options.min_pixels, "of a piece of ground");
  app.add_option("--turn", options.max_turn, "[rad] of the ground from one pixel to the next");
  CLI11_PARSE(app, argc, argv);
  auto config = base::Config::fromFiles({ini});
  for (const auto& setting : settings) config.set(setting);
  config.set(name + ".labels=true");
  const sim::Simulation simulation(config);
  const auto kinds = kindsOf(simulation.world());
  Counts counts;
  for (const auto& sensor : simulation.sensors()) {
    if (sensor->label() != name) continue;
    for (int i = 0; i < frames; ++i) count(sensor->measure(i * sensor->count() / frames), kinds, options, counts);
  }
  auto& times = counts.times;
  std::sort(times.begin(), times.end());
  std::printf(
      "%zu frames of %s, median %.2f ms\n\n| what was measured there | pixels | by its normal | ground |\n"
      "|---|---|---|---|\n",
      times.size(), std::filesystem::path(ini).filename().c_str(), times.empty() ? 0 : times[times.size() / 2]);
  Count ground, others;
  for (const auto& [kind, of_kind] : counts.of_kind) {
    print(toString(kind), of_kind);
    // Kerbs are neither: they end the one and begin the other.
    if (isGround(kind)) {
      ground = ground + of_kind;
    } else if (kind != sim::SurfaceKind::kerb) {
      others = others + of_kind;
    }
  }
  print("ground in all (road, floor)", ground);
  print("all else but kerbs", others);
}
