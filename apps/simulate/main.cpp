// omnimapper-simulate: simulates the world, robot and sensors of an INI and writes a rawlog with its ground truth.
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
      "Simulates a robot's log with its ground truth: rawlog, trajectory, landmarks, labels,\n"
      "flat surfaces and a mesh of the place.\n"
      "Example: omnimapper-simulate -i home.ini -o out/home --set simulation.duration_s=60");
  app.add_option("-i,--ini", arguments.inis,
                 "INI file with world, robot and sensors; later ones override earlier ones");
  app.add_option("-o,--output", arguments.run.folder, "folder for log and ground truth, created if missing");
  app.add_option("--name", arguments.run.name, "name of the rawlog; default: the name of the INI");
  app.add_option("--set", arguments.settings, "section.key=value, overrides the INI file; may be repeated");
  arguments.run.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("--threads", arguments.run.threads,
                 "number of worker threads (default: one for each core); the output does not depend on it")
      ->check(CLI::Range(1, 256));
  app.add_flag("--list", arguments.list, "list the classes of sensors and of the parts of a world, and exit");
  app.add_option("--print-ini", arguments.print_ini, "print the documented INI section of a class and exit");
  app.add_flag("--ini-reference", arguments.ini_reference, "print all INI keys as Markdown and exit");
  app.add_flag("-q,--quiet", arguments.quiet, "no progress, no summary");
  app.footer("Exit codes: doc/exit_codes.md (0 only for a complete log).");
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
  progress.reset();  // clears its line for the summary
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
