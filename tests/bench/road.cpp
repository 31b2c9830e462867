// The ground that is found in images of a simulated stereo camera on a road, against the truth: how many of the
// measured pixels of roads and pavements are classified as ground, and how many of other surfaces. Prints a Markdown
// table. Times are processor times of one thread.
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
  CLI::App app("Evaluates the ground that is found in images of a simulated stereo camera.");
  app.add_option("--ini", ini, "INI of a simulated place");
  app.add_option("--set", settings, "section.key=value, overrides that INI");
  app.add_option("--sensor", name, "label of its RgbdCamera");
  app.add_option("--frames", frames, "number of its frames")->check(CLI::PositiveNumber);
  app.add_option("--sigmas", options.grow_sigmas, "gate of the second pass, in standard deviations");
  app.add_option("--step", options.step_sigmas, "least height of a step that ends the ground, in standard deviations");
  app.add_option("--tilt", options.max_tilt, "[rad] largest angle between found and expected ground");
  app.add_option("--slope", options.max_slope, "[rad] by which the expected range grows with the depth");
  app.add_option("--off", options.max_off, "[m] largest distance between found and expected ground");
  app.add_option("--pixels", options.min_pixels, "least number of pixels of a piece of ground");
  app.add_option("--turn", options.max_turn, "[rad] largest change of the ground's normal from one pixel to the next");
  CLI11_PARSE(app, argc, argv);
  auto config = base::Config::fromFiles({ini});
  for (const auto& setting : settings) config.set(setting);
  config.set(name + ".labels=true");
  const sim::Simulation simulation(config);
  const bench::RoadAgreement agreement(simulation, name, frames, options, bench::processorTime);
  auto times = agreement.times();
  std::sort(times.begin(), times.end());
  std::printf(
      "%zu frames of %s, median %.2f ms\n\n| surface | pixels | ground by its own normal | ground in the end |\n"
      "|---|---|---|---|\n",
      times.size(), std::filesystem::path(ini).filename().c_str(), times.empty() ? 0 : times[times.size() / 2]);
  for (const auto& [kind, count] : agreement.ofKinds())
    print(kind == sim::SurfaceKind::kerb ? "sides of kerbs" : toString(kind), count);
  print("tops of kerbs", agreement.kerbTops());
  print("ground in all (road, floor)", agreement.ground());
  print("all else but kerbs", agreement.others());
  print("all else, sides of kerbs too", agreement.others() + agreement.kerbSides());
  print("all else, tops of kerbs too", agreement.others() + agreement.kerbSides() + agreement.kerbTops());
}
