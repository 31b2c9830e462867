// omnimapper-calibrate: measures from a log how a camera is calibrated, how sensors are mounted, and how people point.
#include <omnimapper/base/Progress.h>
#include <omnimapper/calibration/DepthRun.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "MountingTask.h"
#include "PointingTask.h"
#include "program/Program.h"

namespace {

using namespace omnimapper;

// Options of both tasks.
template <class Request>
CLI::App* addTask(CLI::App& app, const std::string& name, const std::string& help, const std::string& picture,
                  Request& request, bool& quiet) {
  auto* task = app.add_subcommand(name, help);
  task->add_option("-r,--rawlog", request.logs, "log of the camera; several are merged by stamp (-r a -r b)")
      ->required();
  task->add_option("-o,--output", request.output, "folder for calibration.ini, report.txt, summary.json, " + picture)
      ->required();
  task->add_option("--label", request.label,
                   "sensor label of the camera; default: the first sensor with the data that is needed");
  task->add_option("-i,--ini", request.ini,
                   "INI file with a [calibration] section to start from instead of the log's calibration");
  task->add_option("--start", request.start, "leave out observations before this time [s after the start of the log]")
      ->check(program::notNegative());
  task->add_option("--end", request.end,
                   "leave out observations after this time [s after the start of the log]; 0: none")
      ->check(program::notNegative());
  task->add_flag("-q,--quiet", quiet, "no progress, no summary");
  return task;
}

template <class Request>
int runTask(calibration::CalibrationResult (*task)(const Request&, base::Progress&, const std::function<bool()>&),
            const Request& request, const std::string& picture, bool quiet) {
  program::listenForInterrupts();
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, !quiet && isatty(STDERR_FILENO));
  const auto result = task(request, *progress, program::isInterrupted);
  progress.reset();  // clears its line for the summary
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
      "Measures from a log how a camera is calibrated, how the sensors of a robot are mounted, and how people point.\n"
      "Example: omnimapper-calibrate rgbd -r camera.rawlog -o out/calibration\n"
      "         omnimapper-graphslam -i rgbd_handheld.ini -i out/calibration/calibration.ini -r camera.rawlog -o map\n"
      "         omnimapper-calibrate depth -r camera.rawlog -o out/depth\n"
      "         omnimapper-calibrate mounting drive.rawlog -o out/mounting\n"
      "         omnimapper-calibrate pointing -r people.rawlog -g people.csv -o out/pointing",
      "omnimapper-calibrate");
  app.require_subcommand(1);
  app.footer(
      "Record about 30 s in which the camera turns and moves slowly: for rgbd in front of objects with corners,\n"
      "near and far, for depth in front of walls, floors and tables that fill the image.\n"
      "Exit codes: doc/exit_codes.md (0 also if rgbd finds that the log's calibration is right).");
  calibration::CalibrationRequest rgbd;
  calibration::DepthRequest depth;
  bool quiet = false;
  const std::string residuals = "residuals.svg", distortion = "distortion.svg";
  addTask(app, "rgbd",
          "RGB-D camera: intrinsics, lens distortion, pose of the colour camera and depth scale, from image corners",
          residuals, rgbd, quiet)
      ->add_option("--views", rgbd.views, "largest number of images used; more take longer")
      ->check(CLI::Range(10, 500))
      ->capture_default_str();
  auto* of_depth =
      addTask(app, "depth", "RGB-D camera: systematic distortion of depth, from flat walls, floors and tables",
              distortion, depth, quiet);
  of_depth->add_option("--images", depth.images, "largest number of depth images used; more take longer")
      ->check(CLI::Range(12, 1000))
      ->capture_default_str();
  of_depth->add_option("--degree", depth.degree, "degree of the polynomial over the image")
      ->check(CLI::Range(camera::DepthDistortion::kLeastDegree, camera::DepthDistortion::kMostDegree))
      ->capture_default_str();
  MountingArguments mounting;
  auto* of_mounting = addMountingTask(app, mounting);
  PointingArguments pointing;
  auto* of_pointing = addPointingTask(app, pointing);
  return program::run(app, argc, argv, [&, of_depth, of_mounting, of_pointing] {
    if (of_pointing->parsed()) return runPointingTask(pointing);
    if (of_mounting->parsed()) return runMountingTask(mounting);
    if (of_depth->parsed()) return runTask(calibration::runDepthCalibration, depth, distortion, quiet);
    return runTask(calibration::runCalibration, rgbd, residuals, quiet);
  });
}
