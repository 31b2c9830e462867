// How the parts of the mapping of a hand-held depth camera contribute: every log is mapped by ini/rgbd_handheld.ini and
// by variants of it. These differ in the source (depth, brightness, clouds of edges, voxels or all points), in the
// method of registration, and in whether key frames are linked and planes are landmarks. Prints a Markdown table, and
// writes it with a plot and a CSV.
//
// A log is a rawlog with its true trajectory, or a simulated place. doc/results/registration.md shows the table.
//
// Example: bench-camera_ablation --log fr1_rpy=rpy.rawlog,rpy.truth.tum -o out/ablation
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>

#include "AblationPlot.h"

namespace {

using namespace omnimapper;
namespace tests = omnimapper::testing;
namespace fs = std::filesystem;
using bench::AblationRun;
using bench::AblationVariant;

constexpr const char* kExample =
    "Example, with recordings of the TUM RGB-D benchmark and a simulated place:\n"
    "  omnimapper-import tum rgbd_dataset_freiburg1_rpy rpy.rawlog\n"
    "  bench-camera_ablation --log fr1_rpy=rpy.rawlog,rpy.truth.tum \\\n"
    "    --simulate home=rawlogs/home_handheld.ini -o out/ablation";

constexpr const char* kNotes =
    "ATE and largest error after the best rigid alignment; drift: root mean square over 10 m travelled, or, of logs of "
    "less than 20 m, over 1 s, or over 2 m if images are more than 0.2 s apart; processor: the whole run with the "
    "trajectory as its only output.";

const std::vector<std::string> kWithoutPlanes{"perception.extractors=", "mapper.measurement_plugins=view_links"};

AblationVariant visual(const std::string& key, const std::string& title, const std::vector<std::string>& more = {}) {
  AblationVariant variant{key, AblationVariant::Family::visual, title, kWithoutPlanes};
  variant.settings.insert(variant.settings.end(), more.begin(), more.end());
  return variant;
}

AblationVariant byClouds(const std::string& key, const std::string& title, const std::string& source,
                         const std::string& method = "gicp") {
  return {key,
          AblationVariant::Family::clouds,
          title,
          {"perception.extractors=", "mapper.measurement_plugins=", "mapper.pose_plugins=cloud_odometry,no_motion",
           "cloud_odometry.class=CloudOdometryPlugin", "cloud_odometry.source=" + source,
           "cloud_odometry.method=" + method}};
}

AblationVariant withPlanesAlone(AblationVariant variant) {
  variant.settings.insert(variant.settings.end(),
                          {"perception.extractors=planes", "mapper.measurement_plugins=plane_landmarks"});
  return variant;
}

// The first variant is the one with which the plot compares the others. The INI itself has planes.
std::vector<AblationVariant> allVariants() {
  return {visual("no_planes", "depth and brightness"),
          visual("no_links", "without links of key frames", {"mapper.measurement_plugins="}),
          {"planes", AblationVariant::Family::visual, "depth and brightness, with planes (default)", {}},
          visual("depth", "depth alone", {"visual_odometry.use_brightness=false"}),
          visual("brightness", "brightness alone", {"visual_odometry.use_depth=false"}),
          byClouds("occluding_edges", "occluding edges", "occluding_edges"),
          byClouds("rgb_edges", "RGB edges", "rgb_edges"),
          byClouds("high_curvature_edges", "high-curvature edges", "high_curvature_edges"),
          byClouds("voxels", "voxels of 2 cm", "voxels"),
          byClouds("all_points", "all points", "all_points"),
          withPlanesAlone(byClouds("all_points_planes", "all points, with planes", "all_points")),
          byClouds("point_to_plane", "all points, point to plane", "all_points", "point_to_plane"),
          byClouds("point_to_point", "all points, point to point", "all_points", "point_to_point")};
}

struct Log {
  std::string name, rawlog, truth, more_ini;  // more_ini: overrides settings of the common INI; may be empty
};

struct Arguments {
  std::vector<std::string> logs, simulated, variants;
  std::string ini = tests::sourceFile("ini/rgbd_handheld.ini"), out;
  int threads = 1;
  bool redraw = false;
};

// Splits "NAME=A,B,..." into NAME, A, B, ...
std::vector<std::string> partsOf(const std::string& option, const std::string& text, std::size_t least,
                                 std::size_t most) {
  const std::size_t equals = text.find('=');
  std::vector<std::string> parts{text.substr(0, equals)};
  if (equals != std::string::npos) {
    std::stringstream rest(text.substr(equals + 1));
    for (std::string part; std::getline(rest, part, ',');) parts.push_back(part);
  }
  const bool is_named = !parts[0].empty() && parts[0].find_first_of(",/") == std::string::npos;
  if (!is_named || parts.size() < least || parts.size() > most) {
    throw base::Error(base::ExitCode::command_line,
                      option + " " + text + ": does not have the form that --help gives for " + option);
  }
  return parts;
}

Log recordedLog(const std::string& text) {
  const auto parts = partsOf("--log", text, 3, 4);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (!fs::exists(parts[i]))
      throw base::Error(base::ExitCode::unreadable_input, "--log " + text + ": there is no file " + parts[i]);
  }
  return {parts[0], parts[1], parts[2], parts.size() > 3 ? parts[3] : ""};
}

Log simulatedLog(const std::string& text, const std::string& out) {
  const auto parts = partsOf("--simulate", text, 2, 3);
  const bool has_seed = parts.size() > 2;
  const std::string folder = out + "/simulated/" + parts[0] + (has_seed ? "_seed_" + parts[2] : "");
  const Log log{parts[0], folder + "/log.rawlog", folder + "/truth.tum",
                tests::sourceFile("tests/bench/global_shutters.ini")};
  if (fs::exists(log.rawlog)) return log;
  std::fprintf(stderr, "simulating %s ...\n", parts[0].c_str());
  std::vector<std::string> command{
      tests::ownProgram("omnimapper-simulate"), "-q", "-i", parts[1], "--name", "log", "-o", folder};
  if (has_seed)
    command.insert(command.end(), {"--set", "world.seed=" + parts[2], "--set", "simulation.seed=" + parts[2]});
  const auto ended = tests::runProgram(command, {3600, 0});
  if (ended.code != 0) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "--simulate " + text + ": it could not be simulated: " + tests::toString(ended));
  }
  return log;
}

void refuseBadNames(const std::vector<Log>& logs) {
  if (logs.empty()) throw base::Error(base::ExitCode::command_line, "no log: name some by --log or --simulate");
  std::set<std::string> names;
  for (const auto& log : logs) {
    if (!names.insert(log.name).second)
      throw base::Error(base::ExitCode::command_line, "two logs are named " + log.name);
  }
}

std::vector<AblationVariant> chosenVariants(const std::vector<std::string>& keys) {
  const auto all = allVariants();
  std::vector<AblationVariant> chosen;
  for (const auto& variant : all) {
    if (keys.empty() || std::find(keys.begin(), keys.end(), variant.key) != keys.end()) chosen.push_back(variant);
  }
  return chosen;
}

// The span for the drift: 10 m if the trajectory has at least 20 m, else 1 s, or 2 m if images are more than 0.2 s
// apart.
eval::Delta spanOf(const eval::Trajectory& truth) {
  if (eval::distanceTravelled(truth).back() >= 20) return {10, eval::DeltaUnit::metres};
  const double seconds = base::secondsBetween(truth.front().stamp, truth.back().stamp);
  if (seconds < 0.2 * static_cast<double>(truth.size())) return {1, eval::DeltaUnit::seconds};
  return {2, eval::DeltaUnit::metres};
}

// Processor time [s] of this process and of the child processes that have ended, since a log is also read by a child.
double processorSeconds() {
  double seconds = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

/// Shows the progress of one run as a line on the terminal, with the share of all runs that is done. The destructor
/// removes the line.
class RunProgress : public base::Progress {
 public:
  RunProgress(std::size_t run, std::size_t runs, std::string name)
      : run_(static_cast<double>(run)), runs_(static_cast<double>(runs)), name_(std::move(name)) {}
  void report(double fraction, const std::string& /*what*/) override {
    terminal_.report((run_ + fraction) / runs_, name_);
  }

 private:
  base::TerminalProgress terminal_{std::cerr, isatty(STDERR_FILENO) != 0};
  double run_, runs_;
  std::string name_;
};

void judge(AblationRun& run, const std::string& folder, const Log& log) {
  const auto estimate = eval::readTum(folder + "/trajectory.tum"), truth = eval::readTrajectory(log.truth);
  eval::PairingOptions pairing;
  pairing.alignment = eval::Alignment::se3;
  const auto error = eval::absoluteTrajectoryError(estimate, truth, pairing).translation;
  run.ate = error.rmse;
  run.largest = error.max;
  run.travel = eval::distanceTravelled(truth).back();
  run.span = spanOf(truth);
  try {
    run.drift = eval::relativePoseError(estimate, truth, pairing, run.span).translation.rmse;
  } catch (const base::Error&) {
    // No two poses are a span apart, so the drift stays NaN.
  }
}

AblationRun mapAndJudge(const Log& log, const AblationVariant& variant, const Arguments& arguments,
                        RunProgress progress) {
  AblationRun run;
  run.log = log.name;
  run.variant = variant.key;
  const double before = processorSeconds();
  try {
    std::vector<std::string> inis{arguments.ini};
    if (!log.more_ini.empty()) inis.push_back(log.more_ini);
    auto config = base::Config::fromFiles(inis);
    for (const auto& setting : variant.settings) config.set(setting);
    config.set("mapper.output_plugins=trajectory");
    mapper::RunRequest request;
    request.logs = {log.rawlog};
    request.output_folder = arguments.out + "/" + log.name + "/" + variant.key;
    request.threads = arguments.threads;
    fs::create_directories(request.output_folder);
    const auto result = mapper::runMapping(request, config, progress, [] { return false; });
    run.processor_seconds = processorSeconds() - before;
    run.verdict = toString(result.verdict.answer);
    judge(run, result.output_folder, log);
  } catch (const std::exception& error) {
    run.processor_seconds = processorSeconds() - before;
    run.failure = error.what();
  }
  return run;
}

std::string titleOf(const AblationRun& run) {
  for (const auto& variant : allVariants()) {
    if (variant.key == run.variant) return variant.fullTitle();
  }
  return run.variant;
}

void writeAll(const std::string& out, const std::vector<AblationRun>& runs) {
  bench::writeRuns(out + "/ablation.csv", runs);
  std::ofstream markdown(out + "/ablation.md");
  markdown << bench::markdownHeader();
  for (const auto& run : runs) markdown << bench::markdownRow(run, titleOf(run));
  markdown << "\n" << kNotes << "\n";
  std::vector<AblationVariant> shown;
  for (const auto& variant : allVariants()) {
    if (std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return run.variant == variant.key; }))
      shown.push_back(variant);
  }
  bench::AblationPlot(shown, runs).write(out + "/ablation.svg");
}

void print(const AblationRun& run) {
  std::printf("%s", bench::markdownRow(run, titleOf(run)).c_str());
  std::fflush(stdout);
}

void redraw(const std::string& out) {
  const std::string csv = out + "/ablation.csv";
  if (!fs::exists(csv)) throw base::Error(base::ExitCode::unreadable_input, "--redraw: there is no " + csv);
  const auto runs = bench::readRuns(csv);
  std::printf("%s", bench::markdownHeader().c_str());
  for (const auto& run : runs) print(run);
  writeAll(out, runs);
}

void runAll(const Arguments& arguments) {
  fs::create_directories(arguments.out);
  std::vector<Log> logs;
  for (const auto& text : arguments.logs) logs.push_back(recordedLog(text));
  for (const auto& text : arguments.simulated) logs.push_back(simulatedLog(text, arguments.out));
  refuseBadNames(logs);
  const auto variants = chosenVariants(arguments.variants);
  std::vector<AblationRun> runs;
  std::printf("%s", bench::markdownHeader().c_str());
  for (const auto& log : logs) {
    for (const auto& variant : variants) {
      const std::string name = log.name + ", " + variant.fullTitle();
      runs.push_back(
          mapAndJudge(log, variant, arguments, RunProgress(runs.size(), logs.size() * variants.size(), name)));
      print(runs.back());
      // Written after each run, so that an aborted benchmark leaves the results that it had.
      writeAll(arguments.out, runs);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Maps logs of a hand-held depth camera by variants of one INI and compares the trajectories with the truth.");
  app.footer(kExample);
  std::vector<std::string> keys;
  for (const auto& variant : allVariants()) keys.push_back(variant.key);
  app.add_option(
      "--log", arguments.logs,
      "NAME=RAWLOG,TRUTH[,INI]: a log, its true trajectory, and an INI that overrides settings for it, such as "
      "tests/bench/global_shutters.ini; may be repeated");
  app.add_option("--simulate", arguments.simulated,
                 "NAME=INI[,SEED]: a place to simulate, with global shutters; a log that is in the output folder "
                 "already is used again, so remove FOLDER/simulated when the simulator changed; may be repeated");
  app.add_option("-o,--output", arguments.out, "folder for maps, ablation.md, ablation.svg and ablation.csv")
      ->required();
  app.add_option("-i,--ini", arguments.ini, "INI from which the variants are made (ini/rgbd_handheld.ini)")
      ->check(CLI::ExistingFile);
  app.add_option("--variants", arguments.variants, "only these variants")->delimiter(',')->check(CLI::IsMember(keys));
  app.add_option("--threads", arguments.threads, "worker threads; the errors do not depend on it (1)")
      ->check(CLI::PositiveNumber);
  app.add_flag("--redraw", arguments.redraw, "map nothing, only make table and plot from the folder's ablation.csv");
  CLI11_PARSE(app, argc, argv);
  try {
    mapper::loadFeatures();
    arguments.redraw ? redraw(arguments.out) : runAll(arguments);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
