#include <omnimapper/base/Names.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/live/Journal.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <optional>

#include "MappingArguments.h"
#include "Tasks.h"
#include "program/Program.h"

namespace {

using namespace omnimapper;

// Adds an output that the command line requests, whether the INI has it or not.
void addOutput(const std::string& section, const std::string& name, base::Config& config, mapper::RunRequest& run) {
  std::string there;
  if (!config.section(section).find("class", there) || !config.isTrusted(section, "class"))
    config.set(section + ".class=" + name);
  run.more_outputs.push_back(section);
}

// Finds the journal in a folder, and without -i the INI of its live run. Old recordings have none.
void findReplay(Arguments& arguments) {
  auto& journal = arguments.run.replay;
  journal = live::findJournal(journal);
  if (!arguments.inis.empty()) return;
  const auto ini = live::findIni(journal);
  program::require({{"-i INI, as the settings of the live run are not in " + live::iniOf(journal), ini.has_value()}});
  arguments.inis.push_back(*ini);
}

void printResult(const mapper::RunResult& result, const Arguments& arguments) {
  if (arguments.verbose) std::cout << base::printableLines(result.source.text());
  if (!arguments.quiet) std::cout << base::printableLines(mapper::toText(result));
  for (const auto& warning : result.warnings) {
    if (arguments.quiet && result.code == base::ExitCode::ok) break;
    std::cerr << "omnimapper-graphslam: warning: " << base::printableLines(warning) << "\n";
  }
}

int run(Arguments& arguments) {
  program::listenForInterrupts();
  mapper::loadFeatures();
  if (!arguments.run.replay.empty()) findReplay(arguments);
  auto config = readConfig(arguments);
  if (arguments.list_plugins || !arguments.print_ini.empty()) mapper::loadPluginLibraries(config);
  if (arguments.list_plugins) return std::cout << mapper::listPlugins(), 0;
  if (arguments.ini_reference) return std::cout << mapper::iniReference(mapper::fixedSections()), 0;
  if (!arguments.print_ini.empty()) return std::cout << mapper::printIni(arguments.print_ini), 0;
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, isatty(STDERR_FILENO), arguments.quiet);
  const auto stop = program::isInterrupted;
  if (arguments.is_check) return checkLogs(arguments, config, progress, stop);
  if (arguments.record_only) return recordSensors(arguments, config, progress, stop);
  const bool is_of_logs = !arguments.run.live && arguments.run.replay.empty();
  program::require({{"-i INI", !arguments.inis.empty()},
                    {"-r LOG", !is_of_logs || !arguments.run.logs.empty()},
                    {"-o FOLDER", !arguments.run.output_folder.empty()}});
  if (arguments.gui) addOutput("live_window", "LiveWindow", config, arguments.run);
  if (arguments.page) addOutput("page", "LivePage", config, arguments.run);
  if (!arguments.run.localize_map.empty()) addOutput("localization", "LocalizationOutput", config, arguments.run);
  bool is_printed = false;
  arguments.run.before_window_closes = [&](const mapper::RunResult& result) {
    program::nothingIsLeftToDo();
    progress.reset();
    printResult(result, arguments);
    if (!arguments.quiet)
      std::cout << (arguments.gui ? "The window shows the map; close it to end.\n"
                                  : "The page shows the map; Ctrl-C ends.\n")
                << std::flush;
    is_printed = true;
  };
  const auto result = mapObservations(arguments, config, *progress, stop);
  progress.reset();
  if (!is_printed) printResult(result, arguments);
  return static_cast<int>(result.code);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "omnimapper-graphslam");
  addOptions(app, arguments);
  const int code = program::run(app, argc, argv, [&] { return run(arguments); });
  if (!arguments.gui && !arguments.run.live && !arguments.record_only) return code;
  // MRPT's window thread may still paint, and a driver that hangs was abandoned. They cannot be waited for, so the
  // program exits without destroying the objects that they use.
  std::cout.flush();
  std::_Exit(code);
}
