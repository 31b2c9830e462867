// The ground that a stereo camera sees of a simulated road, against the truth: which of the measured pixels of roads
// and pavements are found, and which others are taken for ground. Prints a Markdown table. Times are those of the
// processor, of one thread.
//
// Example: bench-road --ini rawlogs/road.ini --sensor stereo --frames 40

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "RoadAgreement.h"
#include "Timing.h"

namespace {

using namespace omnimapper;
using bench::RoadCount;

void print(const std::string& name, const RoadCount& count) {
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
  app.add_option("--sensor", name, "its DepthCamera");
  app.add_option("--frames", frames, "how many of its frames")->check(CLI::PositiveNumber);
  app.add_option("--sigmas", options.grow_sigmas, "of the second pass");
  app.add_option("--step", options.step_sigmas, "deviations of a step that is no ground");
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
  const bench::RoadAgreement seen(simulation, name, frames, options, bench::processorTime);
  auto times = seen.times();
  std::sort(times.begin(), times.end());
  std::printf(
      "%zu frames of %s, median %.2f ms\n\n| what was measured there | pixels | by its normal | ground |\n"
      "|---|---|---|---|\n",
      times.size(), std::filesystem::path(ini).filename().c_str(), times.empty() ? 0 : times[times.size() / 2]);
  for (const auto& [kind, count] : seen.ofKinds())
    print(kind == sim::SurfaceKind::kerb ? "sides of kerbs" : toString(kind), count);
  print("tops of kerbs", seen.kerbTops());
  print("ground in all (road, floor)", seen.ground());
  print("all else but kerbs", seen.others());
  print("all else, sides of kerbs too", seen.others() + seen.kerbSides());
  print("all else, tops of kerbs too", seen.others() + seen.kerbSides() + seen.kerbTops());
}
