#pragma once

#include <omnimapper/mapper/MappingRun.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "program/Program.h"

/// The command line of omnimapper-graphslam.
struct Arguments {
  omnimapper::mapper::RunRequest run;
  std::string print_ini;
  std::vector<std::string> inis, settings, checked_logs;
  bool is_check = false, list_plugins = false, ini_reference = false, gui = false, page = false, quiet = false,
       verbose = false;
  bool record_only = false;
};

inline void addOptions(CLI::App& app, Arguments& arguments) {
  app.description(
      "Maps a robot's log: reads logs, configured by an INI file, and writes map, pictures and report to a folder.\n"
      "Example:  omnimapper-graphslam -i laser2d.ini -r office.rawlog -o out/office\n"
      "Check:    omnimapper-graphslam --check office.rawlog\n"
      "Continue: omnimapper-graphslam -i laser2d.ini -r next_day.rawlog --continue out/office -o out/both\n"
      "Live:     omnimapper-graphslam -i live_hokuyo_kinect.ini --live -o out/today\n"
      "Localize: omnimapper-graphslam -i laser2d.ini -r next_day.rawlog --localize out/office -o out/located");
  app.add_option("-i,--ini", arguments.inis,
                 "INI file with the plugins and their options; later ones override earlier ones. Without a folder it "
                 "may be one that comes with the program, such as laser2d.ini");
  auto* rawlogs =
      app.add_option("-r,--rawlog", arguments.run.logs,
                     "log of a format of --list-plugins, or rawlog; several are merged by stamp (-r a -r b)");
  auto* live = app.add_flag("--live", arguments.run.live,
                            "map the sensors of [live] until Ctrl-C, and record them in the subfolder recording of -o; "
                            "after the signal USR1 the plugins become those of the INI as it is then");
  auto* record =
      app.add_flag("--record-only", arguments.record_only, "record the sensors of [live] into -o without mapping");
  auto* replay = app.add_option("--replay", arguments.run.replay,
                                "output folder of a --live run, or its journal (recording/TIME.journal): makes the "
                                "same map again, with the INI of that run or with -i")
                     ->type_name("FOLDER");
  live->excludes(rawlogs)->excludes(replay);
  replay->excludes(rawlogs);
  app.add_option("-o,--output", arguments.run.output_folder, "folder for the outputs, created if missing");
  app.add_option_function<std::vector<std::string>>(
         "--check",
         [&arguments](const std::vector<std::string>& logs) {
           arguments.is_check = true;
           for (const auto& log : logs)
             if (!log.empty()) arguments.checked_logs.push_back(log);
         },
         "check a log (or those of -r, or with --live some seconds of sensor data) without mapping: reports problems "
         "and the settings that help; -o saves the report")
      ->expected(0, CLI::detail::expected_max_vector_size)
      ->type_name("LOG");
  auto* go_on = app.add_option("--continue", arguments.run.continue_map,
                               "map (or its folder) to which the logs are added; [session] sets their start");
  auto* localize = app.add_option(
      "--localize", arguments.run.localize_map,
      "map (or its folder) in which the robot is localized; the map is not changed; [session] sets the start");
  app.add_option("--set", arguments.settings, "section.key=value, overrides the INI file; may be repeated");
  app.add_option("--threads", arguments.run.threads,
                 "number of worker threads (default: one for each core); the map does not depend on it")
      ->check(CLI::Range(1, 256));
  app.add_option("--speed", arguments.run.speed,
                 "speed of mapping a log relative to its own pace; 0: as fast as possible")
      ->check(omnimapper::program::notNegative())
      ->excludes(live)
      ->excludes(replay);
  app.add_flag("--strict", arguments.run.strict, "end with exit code 17 if the map is suspicious");
  auto* gui = app.add_flag("--gui", arguments.gui, "show the map while it grows");
  auto* page = app.add_flag("--page", arguments.page,
                            "show the map in browsers while it grows, and then until Ctrl-C; [page] has the settings");
  for (auto* other : {rawlogs, live, replay, go_on, localize, gui, page}) record->excludes(other);
  app.add_flag("--list-plugins", arguments.list_plugins,
               "list the plugin classes, with -i also those of its libraries, and exit");
  app.add_option("--print-ini", arguments.print_ini, "print the documented INI section of a plugin class and exit");
  app.add_flag("--ini-reference", arguments.ini_reference, "print all INI keys as Markdown and exit");
  app.add_flag("-q,--quiet", arguments.quiet, "no progress, no summary; warnings only if the map is not complete");
  app.add_flag("-v,--verbose", arguments.verbose, "also print what the logs contain");
  app.footer("Exit codes: doc/exit_codes.md (0 only for a complete map of a complete log).");
}
