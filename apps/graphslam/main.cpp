#include <omnimapper/base/Progress.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/plugins/registerPlugins.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

namespace {

using namespace omnimapper;

volatile std::sig_atomic_t g_interrupted = 0;
void onInterrupt(int) {
  g_interrupted = 1;
}

struct Arguments {
  mapper::RunRequest run;
  std::string ini, print_ini;
  std::vector<std::string> settings;
  bool list_plugins = false, ini_reference = false, gui = false, quiet = false, verbose = false;
};

int exitCode(base::ExitCode code) {
  return static_cast<int>(code);
}

int run(Arguments& arguments) {
  plugins::registerPlugins();
  auto config = arguments.ini.empty() ? base::Config::fromText("", "no INI") : base::Config::fromFile(arguments.ini);
  for (const auto& setting : arguments.settings) config.set(setting);
  if (arguments.list_plugins || !arguments.print_ini.empty()) mapper::loadPluginLibraries(config);
  if (arguments.list_plugins) return std::cout << mapper::listPlugins(), 0;
  if (arguments.ini_reference) return std::cout << mapper::iniReference(mapper::fixedSections()), 0;
  if (!arguments.print_ini.empty()) return std::cout << mapper::printIni(arguments.print_ini), 0;
  if (arguments.ini.empty() || arguments.run.logs.empty() || arguments.run.output_folder.empty()) {
    throw base::Error(base::ExitCode::command_line, "-i INI, -r LOG and -o FOLDER are needed; see --help");
  }
  if (arguments.gui) {
    arguments.run.more_outputs.push_back("live_window");
    if (!config.has("live_window")) config.set("live_window.class=LiveWindow");
  }
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file at the limit of its size fails as on a full disk
  base::TerminalProgress progress(std::cerr, !arguments.quiet && isatty(STDERR_FILENO));
  const auto result = mapper::runMapping(arguments.run, config, progress, [] { return g_interrupted != 0; });
  if (arguments.verbose) std::cout << result.source.text();
  if (!arguments.quiet) std::cout << mapper::toText(result, arguments.run.output_folder);
  for (const auto& warning : result.warnings) {
    if (arguments.quiet && result.code == base::ExitCode::ok) break;
    std::cerr << "omnimapper-graphslam: warning: " << warning << "\n";
  }
  return exitCode(result.code);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Maps a robot's log: reads rawlogs, configured by an INI file, and leaves map, pictures and report in a folder.\n"
      "Example: omnimapper-graphslam -i ini/laser2d.ini -r office.rawlog -o out/office\n"
      "Go on:   omnimapper-graphslam -i ini/laser2d.ini -r next_day.rawlog --continue out/office -o out/both");
  app.add_option("-i,--ini", arguments.ini, "INI file: which plugins, with which options");
  app.add_option("-r,--rawlog", arguments.run.logs, "rawlog; several are merged by stamp (-r a -r b)");
  app.add_option("-o,--output", arguments.run.output_folder, "folder for the outputs, made if missing");
  app.add_option("--continue", arguments.run.continue_map, "map (or its folder) that the logs go on from: [session]");
  app.add_option("--set", arguments.settings, "section.key=value, over the INI file; may be repeated");
  app.add_option("--threads", arguments.run.threads, "worker threads (one a core); the map does not depend on them")
      ->check(CLI::Range(1, 256));
  app.add_option("--speed", arguments.run.speed, "replay at so many times the log's pace; 0: as fast as possible")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--gui", arguments.gui, "show the map while it grows");
  app.add_flag("--list-plugins", arguments.list_plugins,
               "list the plugin classes, with -i those of its libraries too, and leave");
  app.add_option("--print-ini", arguments.print_ini, "print the documented section of a plugin class and leave");
  app.add_flag("--ini-reference", arguments.ini_reference, "print all INI keys as Markdown and leave");
  app.add_flag("-q,--quiet", arguments.quiet, "no progress, no summary; warnings only if the map is not whole");
  app.add_flag("-v,--verbose", arguments.verbose, "also say what the logs hold");
  app.footer("Exit codes: doc/exit_codes.md (0 only for a whole map of a whole log).");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exitCode(base::ExitCode::command_line);
  }
  try {
    return run(arguments);
  } catch (const base::Error& error) {
    std::cerr << "omnimapper-graphslam: " << error.what() << "\n";
    return exitCode(error.code());
  } catch (const std::exception& error) {
    std::cerr << "omnimapper-graphslam: " << error.what() << " (a defect: please report it)\n";
    return exitCode(base::ExitCode::internal);
  }
}
