// omnimapper-simulate: a world, a robot and its sensors of an INI become a rawlog and the truth beside it.
#include <omnimapper/base/Progress.h>
#include <omnimapper/sim/SimulationHelp.h>
#include <omnimapper/sim/SimulationRun.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <thread>

#include "program/Program.h"
#include "program/ShippedInis.h"

namespace {

using namespace omnimapper;

struct Arguments {
  std::vector<std::string> inis, settings;
  std::string print_ini;
  sim::SimulationRequest run;
  bool list = false, ini_reference = false, quiet = false;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  app.description(
      "Simulates a robot's log with its truth: rawlog, trajectory, landmarks, labels,\n"
      "flat surfaces and a mesh of the place.\n"
      "Example: omnimapper-simulate -i home.ini -o out/home --set simulation.duration_s=60");
  app.add_option("-i,--ini", arguments.inis, "INI file: world, robot, sensors; a further one counts over it");
  app.add_option("-o,--output", arguments.run.folder, "folder for log and truth, made if missing");
  app.add_option("--name", arguments.run.name, "of the rawlog (the INI's)");
  app.add_option("--set", arguments.settings, "section.key=value, over the INI file; may be repeated");
  arguments.run.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("--threads", arguments.run.threads, "worker threads (one a core); the bytes do not depend on them")
      ->check(CLI::Range(1, 256));
  app.add_flag("--list", arguments.list, "list sensors and what a world is made of, and leave");
  app.add_option("--print-ini", arguments.print_ini, "print the documented section of a class and leave");
  app.add_flag("--ini-reference", arguments.ini_reference, "print all INI keys as Markdown and leave");
  app.add_flag("-q,--quiet", arguments.quiet, "no progress, no summary");
  app.footer("Exit codes: doc/exit_codes.md (0 only for a whole log).");
}

int run(Arguments& arguments) {
  if (arguments.list) return std::cout << sim::listClasses(), 0;
  if (arguments.ini_reference) return std::cout << sim::iniReference(), 0;
  if (!arguments.print_ini.empty()) return std::cout << sim::printIni(arguments.print_ini), 0;
  if (arguments.inis.empty() || arguments.run.folder.empty())
    throw base::Error(base::ExitCode::command_line, "-i INI and -o FOLDER are needed; see --help");
  auto config = base::Config::fromFiles(program::findInis(arguments.inis, "rawlogs"));
  for (const auto& setting : arguments.settings) config.set(setting);
  if (arguments.run.name.empty()) arguments.run.name = std::filesystem::path(arguments.inis.front()).stem().string();
  program::listenForInterrupts();
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, !arguments.quiet && isatty(STDERR_FILENO));
  const sim::Simulation simulation(config);
  const auto result = sim::runSimulation(simulation, arguments.run, *progress, program::isInterrupted);
  progress.reset();  // its line is free for the summary
  if (!arguments.quiet) std::cout << sim::toText(result, arguments.run.folder);
  for (const auto& warning : result.warnings) std::cerr << "omnimapper-simulate: warning: " << warning << "\n";
  return static_cast<int>(result.code);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "omnimapper-simulate");
  addOptions(app, arguments);
  return program::run(app, argc, argv, [&] { return run(arguments); });
}
