#include "PointingTask.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/base/Progress.h>
#include <unistd.h>

#include <iostream>
#include <map>
#include <optional>

#include "program/Program.h"

using namespace omnimapper;

namespace {

using interaction::SkeletonAxes;
using interaction::SkeletonUnit;

const std::map<std::string, SkeletonUnit> kUnits = {
    {"recognised", SkeletonUnit::recognised}, {"m", SkeletonUnit::m}, {"mm", SkeletonUnit::mm}};
const std::map<std::string, SkeletonAxes> kAxes = {{"recognised", SkeletonAxes::recognised},
                                                   {"sensor", SkeletonAxes::sensor},
                                                   {"flipped_y", SkeletonAxes::flipped_y},
                                                   {"forward_y_up", SkeletonAxes::forward_y_up},
                                                   {"forward_optical", SkeletonAxes::forward_optical}};

}  // namespace

CLI::App* addPointingTask(CLI::App& app, PointingArguments& arguments) {
  auto& request = arguments.request;
  auto* task = app.add_subcommand(
      "pointing", "tracker of skeletons: how far people miss what they point at, from gestures at known targets");
  task->add_option("-r,--rawlog", request.logs, "rawlog with skeletons; several are merged by stamp (-r a -r b)")
      ->required();
  task->add_option("-g,--gestures", request.gestures,
                   "table of comma-separated fields under person,target,x_m,y_m,z_m,begin_s, with the target in the "
                   "base and Unix times of the log; may have end_s (else 30 skeletons) and arm (else right)")
      ->required();
  task->add_option("-o,--output", request.output, "folder for pointing.csv, report.txt, pointing.svg")->required();
  task->add_option("--label", request.label, "sensor label of the tracker; default: all skeletons");
  task->add_option("--unit", arguments.unit, "unit of the joints")->check(CLI::IsMember(kUnits))->capture_default_str();
  task->add_option("--axes", arguments.axes, "axes of the joints, as the key skeleton_axes of [labels] has them")
      ->check(CLI::IsMember(kAxes))
      ->capture_default_str();
  task->add_flag("--mirrored", request.format.is_mirrored, "the tracker calls the right side of a person left");
  task->add_flag("-q,--quiet", arguments.quiet, "no progress, no summary");
  task->footer(
      "Example: omnimapper-calibrate pointing -r people.rawlog -g people.csv -o out/pointing\n"
      "Let six people or more point at each of some targets around them, for a second or more, two metres before the "
      "sensor.");
  return task;
}

int runPointingTask(PointingArguments arguments) {
  program::listenForInterrupts();
  arguments.request.format.unit = kUnits.at(arguments.unit);
  arguments.request.format.axes = kAxes.at(arguments.axes);
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr,
                                                 !arguments.quiet && isatty(STDERR_FILENO) != 0);
  const auto result = calibration::runPointingCalibration(arguments.request, *progress, program::isInterrupted);
  progress.reset();  // clears its line for the summary
  for (const auto& warning : result.warnings)
    std::cerr << "omnimapper-calibrate: warning: " << base::printableLines(warning) << "\n";
  if (!arguments.quiet)
    std::cout << base::printableLines(result.text) << "in " << arguments.request.output
              << ": pointing.csv, report.txt, pointing.svg\n";
  return static_cast<int>(result.code);
}
