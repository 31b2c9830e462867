#include <omnimapper/base/Progress.h>
#include <omnimapper/check/CheckRun.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/plugins/registerPlugins.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <iostream>

#include "Arguments.h"

namespace {

using namespace omnimapper;

volatile std::sig_atomic_t g_interrupted = 0;
void onInterrupt(int) {
  g_interrupted = 1;
}

int exitCode(base::ExitCode code) {
  return static_cast<int>(code);
}

int run(Arguments& arguments) {
  plugins::registerPlugins();
  auto config = base::Config::fromFiles(arguments.inis);
  for (const auto& setting : arguments.settings) config.set(setting);
  if (arguments.list_plugins || !arguments.print_ini.empty()) mapper::loadPluginLibraries(config);
  if (arguments.list_plugins) return std::cout << mapper::listPlugins(), 0;
  if (arguments.ini_reference) return std::cout << mapper::iniReference(mapper::fixedSections()), 0;
  if (!arguments.print_ini.empty()) return std::cout << mapper::printIni(arguments.print_ini), 0;
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file at the limit of its size fails as on a full disk
  base::TerminalProgress progress(std::cerr, !arguments.quiet && isatty(STDERR_FILENO));
  const auto stop = [] { return g_interrupted != 0; };
  if (!arguments.checked_logs.empty()) {
    const auto checked = check::runCheck(arguments.checked_logs, config, arguments.run.output_folder, progress, stop);
    return std::cout << checked.text, exitCode(checked.code);
  }
  if (arguments.inis.empty() || arguments.run.logs.empty() || arguments.run.output_folder.empty()) {
    throw base::Error(base::ExitCode::command_line, "-i INI, -r LOG and -o FOLDER are needed; see --help");
  }
  if (arguments.gui) {
    arguments.run.more_outputs.push_back("live_window");
    if (!config.has("live_window")) config.set("live_window.class=LiveWindow");
  }
  const auto result = mapper::runMapping(arguments.run, config, progress, stop);
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
  CLI::App app;
  addOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exitCode(base::ExitCode::command_line);
  }
  try {
    const int code = run(arguments);
    if (!arguments.gui) return code;
    // MRPT's window thread may still paint, and cannot be waited for: what it uses must not go before it does.
    std::cout.flush();
    std::_Exit(code);
  } catch (const base::Error& error) {
    std::cerr << "omnimapper-graphslam: " << error.what() << "\n";
    return exitCode(error.code());
  } catch (const std::exception& error) {
    std::cerr << "omnimapper-graphslam: " << error.what() << " (a defect: please report it)\n";
    return exitCode(base::ExitCode::internal);
  }
}
