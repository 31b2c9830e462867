// omnimapper-calibrate: refines what a log says of its sensors, from the log itself.
#include <omnimapper/base/Progress.h>
#include <omnimapper/calibration/CalibrationRun.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "program/Program.h"

namespace {

using namespace omnimapper;

struct Arguments {
  calibration::CalibrationRequest run;
  bool quiet = false;
};

void addRgbd(CLI::App& app, Arguments& arguments) {
  auto* rgbd = app.add_subcommand("rgbd", "camera with depths: intrinsics, lens, place of the picture, depth scale");
  auto& run = arguments.run;
  rgbd->add_option("-r,--rawlog", run.logs, "rawlog of the camera; several are merged by stamp (-r a -r b)")
      ->required();
  rgbd->add_option("-o,--output", run.output, "folder for calibration.ini, report.txt, summary.json, residuals.svg")
      ->required();
  rgbd->add_option("--label", run.label, "sensor label of the camera; default: the first with depths and picture");
  rgbd->add_option("-i,--ini", run.ini, "INI file with a [calibration] to start from instead of the log's");
  rgbd->add_option("--start", run.start, "leave out what is before [s after the log's begin]")
      ->check(omnimapper::program::notNegative());
  rgbd->add_option("--end", run.end, "leave out what is after [s after the log's begin]; 0: nothing")
      ->check(omnimapper::program::notNegative());
  rgbd->add_option("--views", run.views, "images that are taken at most; more take longer")
      ->check(CLI::Range(10, 500))
      ->capture_default_str();
  rgbd->add_flag("-q,--quiet", arguments.quiet, "no progress, no summary");
}

int run(const Arguments& arguments) {
  program::listenForInterrupts();
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, !arguments.quiet && isatty(STDERR_FILENO));
  const auto result = calibration::runCalibration(arguments.run, *progress, program::isInterrupted);
  progress.reset();  // its line is free for the summary
  const auto& folder = arguments.run.output;
  if (!arguments.quiet) std::cout << result.text << "in " << folder << ": calibration.ini, residuals.svg\n";
  for (const auto& warning : result.warnings) std::cerr << "omnimapper-calibrate: warning: " << warning << "\n";
  if (!arguments.quiet && result.is_better)
    std::cout << "next: omnimapper-graphslam -i INI -i " << folder << "/calibration.ini -r LOG -o FOLDER\n";
  return static_cast<int>(result.code);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Refines what a log says of its camera, from the log itself, by bundle adjustment.\n"
      "Example: omnimapper-calibrate rgbd -r camera.rawlog -o out/calibration\n"
      "         omnimapper-graphslam -i rgbd_handheld.ini -i out/calibration/calibration.ini -r camera.rawlog -o "
      "out/map",
      "omnimapper-calibrate");
  app.require_subcommand(1);
  app.footer(
      "Record some 30 s in which the camera turns and moves slowly, before things with corners, near and far.\n"
      "Exit codes: doc/exit_codes.md (0 also where the log's calibration turns out to hold).");
  Arguments arguments;
  addRgbd(app, arguments);
  return program::run(app, argc, argv, [&] { return run(arguments); });
}
