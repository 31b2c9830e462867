// omnimapper-calibrate: refines what a log says of its sensors, from the log itself.
#include <omnimapper/base/Progress.h>
#include <omnimapper/calibration/DepthRun.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "program/Program.h"

namespace {

using namespace omnimapper;
using calibration::CalibrationResult;

struct Arguments {
  calibration::CalibrationRequest rgbd;
  calibration::DepthRequest depth;
  bool quiet = false;
};

// What both tasks take.
template <class Request>
CLI::App* addTask(CLI::App& app, const std::string& name, const std::string& help, const std::string& picture,
                  Request& request, bool& quiet) {
  auto* task = app.add_subcommand(name, help);
  task->add_option("-r,--rawlog", request.logs, "rawlog of the camera; several are merged by stamp (-r a -r b)")
      ->required();
  task->add_option("-o,--output", request.output, "folder for calibration.ini, report.txt, summary.json, " + picture)
      ->required();
  task->add_option("--label", request.label, "sensor label of the camera; default: the first that has what is needed");
  task->add_option("-i,--ini", request.ini, "INI file with a [calibration] to start from instead of the log's");
  task->add_option("--start", request.start, "leave out what is before [s after the log's begin]")
      ->check(program::notNegative());
  task->add_option("--end", request.end, "leave out what is after [s after the log's begin]; 0: nothing")
      ->check(program::notNegative());
  task->add_flag("-q,--quiet", quiet, "no progress, no summary");
  return task;
}

template <class Request>
int runTask(CalibrationResult (*task)(const Request&, base::Progress&, const std::function<bool()>&),
            const Request& request, const std::string& picture, bool quiet) {
  program::listenForInterrupts();
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, !quiet && isatty(STDERR_FILENO));
  const auto result = task(request, *progress, program::isInterrupted);
  progress.reset();  // its line is free for the summary
  const auto& folder = request.output;
  if (!quiet) std::cout << result.text << "in " << folder << ": calibration.ini, " << picture << "\n";
  for (const auto& warning : result.warnings) std::cerr << "omnimapper-calibrate: warning: " << warning << "\n";
  if (!quiet && result.is_better)
    std::cout << "next: omnimapper-graphslam -i INI -i " << folder << "/calibration.ini -r LOG -o FOLDER\n";
  return static_cast<int>(result.code);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Refines what a log says of its camera, from the log itself.\n"
      "Example: omnimapper-calibrate rgbd -r camera.rawlog -o out/calibration\n"
      "         omnimapper-graphslam -i rgbd_handheld.ini -i out/calibration/calibration.ini -r camera.rawlog -o "
      "out/map\n"
      "         omnimapper-calibrate depth -r camera.rawlog -o out/depth",
      "omnimapper-calibrate");
  app.require_subcommand(1);
  app.footer(
      "Record some 30 s in which the camera turns and moves slowly: for rgbd before things with corners, near and "
      "far,\n"
      "for depth before walls, floors and tables that fill the image.\n"
      "Exit codes: doc/exit_codes.md (0 also where rgbd finds that the log's calibration holds).");
  Arguments arguments;
  auto& [rgbd, depth, quiet] = arguments;
  const std::string residuals = "residuals.svg", distortion = "distortion.svg";
  addTask(app, "rgbd", "camera with depths: intrinsics, lens, place of the picture, depth scale, by its corners",
          residuals, rgbd, quiet)
      ->add_option("--views", rgbd.views, "images that are taken at most; more take longer")
      ->check(CLI::Range(10, 500))
      ->capture_default_str();
  auto* of_depth = addTask(app, "depth", "camera with depths: by how much it bends flat walls, floors and tables",
                           distortion, depth, quiet);
  of_depth->add_option("--images", depth.images, "depth images that are taken at most; more take longer")
      ->check(CLI::Range(12, 1000))
      ->capture_default_str();
  of_depth->add_option("--degree", depth.degree, "of the polynomial over the image")
      ->check(CLI::Range(perception::DepthDistortion::kLeastDegree, perception::DepthDistortion::kMostDegree))
      ->capture_default_str();
  return program::run(app, argc, argv, [&, of_depth] {
    if (of_depth->parsed())
      return runTask(calibration::runDepthCalibration, arguments.depth, distortion, arguments.quiet);
    return runTask(calibration::runCalibration, arguments.rgbd, residuals, arguments.quiet);
  });
}
