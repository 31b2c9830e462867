#include "MountingTask.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/check/MountingRun.h>
#include <omnimapper/mapper/Features.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "program/Program.h"
#include "program/ShippedInis.h"

using namespace omnimapper;

CLI::App* addMountingTask(CLI::App& app, MountingArguments& arguments) {
  auto* task =
      app.add_subcommand("mounting",
                         "robot with a laser or a depth camera: how its sensors are mounted, their clocks, and "
                         "the sweep of the laser, from walls, floor and motion");
  task->add_option("-r,--rawlog,LOG", arguments.logs, "logs of one drive; several are merged by stamp")->required();
  task->add_option("-o,--output", arguments.output, "folder for mounting.ini and report.txt")->required();
  task->add_option("-i,--ini", arguments.inis,
                   "INI that declares the sensors; what it declares is measured, and mounting.ini is given after it")
      ->allow_extra_args(false);
  task->add_flag("-q,--quiet", arguments.quiet, "no progress, no summary");
  task->footer(
      "Example: omnimapper-calibrate mounting drive.rawlog -i home_planes.ini -o out/mounting\n"
      "         omnimapper-graphslam -i home_planes.ini -i out/mounting/mounting.ini -r drive.rawlog -o out/map\n"
      "Record a minute or two in rooms with walls, with turns on the spot that begin and end, and straight drives.\n"
      "Exit codes: doc/exit_codes.md (15 if something has two causes or the log still contradicts what is declared).");
  return task;
}

int runMountingTask(const MountingArguments& arguments) {
  program::listenForInterrupts();
  mapper::loadFeatures();
  const auto config = base::Config::fromFiles(program::findInis(arguments.inis));
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr,
                                                 !arguments.quiet && isatty(STDERR_FILENO) != 0);
  const auto result = check::runMounting(arguments.logs, config, arguments.output, *progress, program::isInterrupted);
  progress.reset();  // clears its line for the summary
  for (const auto& warning : result.warnings)
    std::cerr << "omnimapper-calibrate: warning: " << base::printableLines(warning) << "\n";
  if (arguments.quiet) return static_cast<int>(result.code);
  std::cout << base::printableLines(result.text) << "\nin " << arguments.output << ": mounting.ini, report.txt\n";
  if (result.code == base::ExitCode::ok)
    std::cout << "next: omnimapper-graphslam -i INI -i " << arguments.output << "/mounting.ini -r LOG -o FOLDER\n";
  return static_cast<int>(result.code);
}
