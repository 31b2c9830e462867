#include "Tasks.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/check/CheckRun.h>
#include <omnimapper/check/LogWatch.h>
#include <omnimapper/live/record.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>

#include "program/Program.h"
#include "program/ShippedInis.h"

using namespace omnimapper;

namespace {

// A temporary folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "omnimapper-check-XXXXXX").string()) {
    if (!mkdtemp(path_.data()))
      throw base::Error(base::ExitCode::unwritable_output, path_ + ": no folder can be created there; set TMPDIR");
  }
  ~TemporaryFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

base::Config readConfig(const Arguments& arguments) {
  auto config = base::Config::fromFiles(program::findInis(arguments.inis));
  for (const auto& setting : arguments.settings) config.set(setting);
  return config;
}

int checkLogs(const Arguments& arguments, const base::Config& config, std::optional<base::TerminalProgress>& progress,
              const std::function<bool()>& stop) {
  auto logs = arguments.checked_logs;
  logs.insert(logs.end(), arguments.run.logs.begin(), arguments.run.logs.end());
  std::optional<TemporaryFolder> folder;
  std::string heading, troubles;
  if (arguments.run.live) {
    folder.emplace();
    const auto options = config.section("live").read<live::LiveOptions>();
    const auto recorded = live::record(options, config, folder->path(), options.check, *progress, stop);
    for (const auto& trouble : live::troublesOf(recorded)) troubles += "PROBLEM " + trouble + ".\n";
    if (recorded.counts.arrived == 0) {
      progress.reset();
      std::cout << base::printableLines(live::toText(recorded) + troubles) << std::flush;
      return static_cast<int>(base::ExitCode::nothing_to_map);
    }
    heading = troubles + live::toText(recorded) + (recorded.failure.empty() ? "" : recorded.failure + "\n") + "\n";
    logs = recorded.files;
  }
  program::require({{"--check LOG", !logs.empty()}});
  const auto checked = check::runCheck(logs, config, arguments.run.output_folder, *progress, stop);
  progress.reset();
  std::cout << base::printableLines(heading + checked.text) << std::flush;
  const std::string ini = arguments.run.output_folder + "/check.ini";
  if (!arguments.run.output_folder.empty() && std::filesystem::exists(ini)) std::cerr << ini << " is written.\n";
  const bool is_doubtful = checked.code == base::ExitCode::ok && !troubles.empty();
  return static_cast<int>(is_doubtful ? base::ExitCode::doubtful_input : checked.code);
}

mapper::RunResult mapObservations(Arguments& arguments, const base::Config& config, base::Progress& progress,
                                  const std::function<bool()>& stop) {
  auto& run = arguments.run;
  const bool is_of_logs = !run.live && run.replay.empty();
  if (run.live) {
    program::listenForRereads();
    run.changed_config = [&arguments] {
      return program::takeReread() ? std::optional(readConfig(arguments)) : std::nullopt;
    };
  }
  if (is_of_logs && run.localize_map.empty()) run.watch = std::make_shared<check::LogWatch>(config);
  return mapper::runMapping(run, config, progress, stop);
}

int recordSensors(const Arguments& arguments, const base::Config& config,
                  std::optional<base::TerminalProgress>& progress, const std::function<bool()>& stop) {
  program::require({{"-i INI", !arguments.inis.empty()}, {"-o FOLDER", !arguments.run.output_folder.empty()}});
  const auto recorded = live::record(config.section("live").read<live::LiveOptions>(), config,
                                     arguments.run.output_folder, 0, *progress, stop);
  progress.reset();
  if (!arguments.quiet) std::cout << base::printableLines(live::toText(recorded)) << std::flush;
  if (!recorded.failure.empty()) std::cerr << "omnimapper-graphslam: " << recorded.failure << "\n";
  return static_cast<int>(recorded.code());
}
