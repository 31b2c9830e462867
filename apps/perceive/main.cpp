// omnimapper-perceive: derives a rawlog from a rawlog with the extractors of an INI.
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PerceptionRun.h>
#include <omnimapper/mapper/PluginHelp.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/pictures/DetectionCounts.h>
#include <omnimapper/pictures/PerceptionPictures.h>
#include <unistd.h>

#include <iostream>
#include <optional>
#include <thread>

#include "program/Program.h"
#include "program/ShippedInis.h"

namespace {

using namespace omnimapper;

struct Arguments {
  std::vector<std::string> inis, settings;
  mapper::PerceptionRequest run;
  std::string pictures, print_ini;
  int picture_every = 10;
  bool quiet = false, verbose = false, list_plugins = false;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  app.description(
      "Runs only perception: reads logs and writes the results of the extractors in [perception] of an INI to a\n"
      "rawlog. omnimapper-graphslam reads it together with the raw one: -r raw.rawlog -r derived.rawlog\n"
      "Example: omnimapper-perceive -i laser2d.ini -r office.rawlog -o derived.rawlog");
  app.add_option("-i,--ini", arguments.inis, "INI file with the extractors; later ones override earlier ones");
  app.add_option("-r,--rawlog", arguments.run.logs,
                 "log of a format of --list-plugins, or rawlog; several are merged by stamp (-r a -r b)");
  app.add_option("-o,--output", arguments.run.output, "rawlog to write");
  app.add_flag("--with-raw", arguments.run.with_raw, "also write the observations that were read");
  app.add_option("--pictures", arguments.pictures, "folder for pictures of the results, drawn over the sensor data");
  app.add_option("--picture-every", arguments.picture_every, "draw every Nth observation of a sensor; default 10")
      ->check(omnimapper::program::positive());
  app.add_option("--set", arguments.settings, "section.key=value, overrides the INI file; may be repeated");
  arguments.run.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  app.add_option("--threads", arguments.run.threads,
                 "number of worker threads (default: one for each core); the output does not depend on it")
      ->check(CLI::Range(1, 256));
  app.add_flag("--list-plugins", arguments.list_plugins,
               "list the plugin classes, with -i also those of its libraries, and exit");
  app.add_option("--print-ini", arguments.print_ini, "print the documented INI section of a plugin class and exit");
  app.add_flag("-q,--quiet", arguments.quiet, "no progress, no summary");
  app.add_flag("-v,--verbose", arguments.verbose, "also print what the logs contain");
  app.footer(
      "MRPT's tools stop at unknown classes, so load ours: RawLogViewer -l libomnimapper-obs.so derived.rawlog\n"
      "Exit codes: doc/exit_codes.md (0 only for the complete output of a complete log).");
}

int run(Arguments& arguments) {
  mapper::loadFeatures();
  auto config = base::Config::fromFiles(program::findInis(arguments.inis));
  for (const auto& setting : arguments.settings) config.set(setting);
  if (arguments.list_plugins || !arguments.print_ini.empty()) mapper::loadPluginLibraries(config);
  if (arguments.list_plugins) return std::cout << mapper::listPlugins(), 0;
  if (!arguments.print_ini.empty()) return std::cout << mapper::printIni(arguments.print_ini), 0;
  program::require({{"-i INI", !arguments.inis.empty()},
                    {"-r LOG", !arguments.run.logs.empty()},
                    {"-o RAWLOG", !arguments.run.output.empty()}});
  for (const auto& inputs : {arguments.run.logs, arguments.inis}) {
    base::refuseToReplaceInput(arguments.run.output, inputs);
  }
  program::listenForInterrupts();
  std::optional<pictures::PerceptionPictures> pictures;
  pictures::DetectionCounts counts;
  if (!arguments.pictures.empty()) pictures.emplace(arguments.pictures, arguments.picture_every);
  arguments.run.show = [&](const auto& raw, const auto& derived) {
    counts.add(derived);
    if (pictures) pictures->add(raw, derived);
  };
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, !arguments.quiet && isatty(STDERR_FILENO));
  const auto result = mapper::runPerception(arguments.run, config, *progress, program::isInterrupted);
  progress.reset();  // clears its line for the summary
  if (arguments.verbose) std::cout << result.source.text();
  if (!arguments.quiet) std::cout << counts.text() << mapper::toText(result, arguments.run.output);
  if (!arguments.quiet && pictures) std::cout << pictures->count() << " pictures in " << arguments.pictures << "\n";
  for (const auto& warning : result.warnings) std::cerr << "omnimapper-perceive: warning: " << warning << "\n";
  return static_cast<int>(result.code);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "omnimapper-perceive");
  addOptions(app, arguments);
  return program::run(app, argc, argv, [&] { return run(arguments); });
}
