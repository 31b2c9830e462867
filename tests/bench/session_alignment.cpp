// Sessions that may begin anywhere: a log is cut in two at several places. One part is mapped, and the other continues
// that map with [session] start = anywhere, in both orders. The result is compared with the map of the log in one
// piece. Prints a Markdown table.
//
// Example: bench-session_alignment -i ini/laser2d.ini -r aces.rawlog -o out/alignment
#include <omnimapper/base/Progress.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "LogParts.h"

namespace {

using namespace omnimapper;
using log_parts::mapIn;
using log_parts::spanOf;
using log_parts::trajectoryOf;
using log_parts::write;

struct Setup {
  std::string ini, log, out;
  std::vector<std::string> settings;
  int threads = 1;
};

mapper::RunResult run(const Setup& setup, const std::string& log, const std::string& folder,
                      const std::string& continued) {
  auto config = base::Config::fromFile(setup.ini);
  for (const auto& setting : setup.settings) config.set(setting);
  config.set("mapper.output_plugins=map,trajectory,report");
  if (!continued.empty()) config.set("session.start=anywhere");
  mapper::RunRequest request;
  request.logs = {log};
  request.output_folder = folder;
  request.threads = setup.threads;
  request.continue_map = continued;
  base::Progress quiet;
  return mapper::runMapping(request, config, quiet, [] { return false; });
}

// Distance [m] that the newest session had travelled when it was aligned with the map.
double travelUntilAligned(const map::Map& map) {
  const auto& session = map.sessions.back();
  double travel = 0;
  const map::KeyFrame* before = nullptr;
  for (const auto& frame : map.key_frames) {
    if (frame.id.session != session.number) continue;
    if (before) travel += (frame.map_from_base.translation() - before->map_from_base.translation()).norm();
    if (frame.id == session.aligned_at) break;
    before = &frame;
  }
  return travel;
}

void printRow(const std::string& name, const mapper::RunResult& first, const mapper::RunResult& second,
              const map::Map& both, const eval::Trajectory& whole) {
  eval::PairingOptions pairing;
  pairing.alignment = eval::Alignment::yaw;
  const auto error = eval::absoluteTrajectoryError(trajectoryOf(both), whole, pairing).translation;
  std::string aligned = "no";
  char text[64];
  if (both.sessions.back().aligned) {
    std::snprintf(text, sizeof text, "after %.1f m", travelUntilAligned(both));
    aligned = text;
  }
  std::printf("| %s | %.0f, %.0f | %s | %.3f, %.2f | %.1f, %.1f |\n", name.c_str(), first.travel, second.travel,
              aligned.c_str(), error.rmse, error.max, first.wall_seconds, second.wall_seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Setup setup;
  std::vector<double> cuts{0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  CLI::App app("Cuts a log in two and aligns the parts, without giving the pose at which the second begins.");
  app.add_option("-i,--ini", setup.ini)->required();
  app.add_option("-r,--rawlog", setup.log)->required();
  app.add_option("-o,--output", setup.out)->required();
  app.add_option("--cuts", cuts, "where to cut, in parts of the log's time");
  app.add_option("--threads", setup.threads);
  app.add_option("--set", setup.settings, "section.key=value");
  CLI11_PARSE(app, argc, argv);
  omnimapper::mapper::loadFeatures();
  std::filesystem::create_directories(setup.out);
  run(setup, setup.log, setup.out + "/whole", "");
  const auto whole = trajectoryOf(mapIn(setup.out + "/whole"));
  const auto [begin, end] = spanOf(setup.log);
  std::printf(
      "| cut at, first mapped | length of the first, the second [m] | aligned | distance from the map in one piece: "
      "rmse, max [m] | wall time of the first, the second [s] |\n|---|---|---|---|---|\n");
  for (const double cut : cuts) {
    const auto stamp = begin + base::durationFromSeconds(cut * base::secondsBetween(begin, end));
    const std::string name = setup.out + "/" + std::to_string(static_cast<int>(std::lround(100 * cut)));
    write(setup.log, base::Stamp::min(), stamp, name + "a.rawlog");
    write(setup.log, stamp, base::Stamp::max(), name + "b.rawlog");
    for (const bool forward : {true, false}) {
      const std::string first = name + (forward ? "a" : "b"), second = name + (forward ? "b" : "a");
      const auto of_first = run(setup, first + ".rawlog", first, "");
      const auto of_second = run(setup, second + ".rawlog", second + "_continued", first + "/map.omnimap");
      char row[64];
      std::snprintf(row, sizeof row, "%.0f %%, %s part", 100 * cut, forward ? "earlier" : "later");
      printRow(row, of_first, of_second, mapIn(second + "_continued"), whole);
    }
  }
}
