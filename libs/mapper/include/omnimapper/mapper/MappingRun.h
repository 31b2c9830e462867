#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/PluginHelp.h>
#include <omnimapper/plugin/LiveMetrics.h>
#include <omnimapper/plugin/Verdict.h>
#include <omnimapper/source/SourceReport.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace omnimapper::mapper {

/// How a run went.
struct RunResult {
  base::ExitCode code = base::ExitCode::ok;
  std::vector<std::string> warnings;
  Verdict verdict;  ///< on the whole map; without evidence in a run that localizes
  source::SourceReport source;
  std::string output_folder;                ///< where the outputs are: that of the request, or one in it
  bool took_place = false;                  ///< they replaced those of an earlier run
  std::vector<std::string> foreign_files;   ///< what else is in the folder of the request, and no run made
  std::size_t key_frames = 0, factors = 0;  ///< of the whole map
  std::size_t new_key_frames = 0, closures = 0, refused_closures = 0;
  std::size_t localized = 0, located = 0;  ///< of a run that localizes: key frames, and those whose place was known
  bool awaits_confirmation = false;        ///< it found a place in the map, and no second one that agrees
  std::map<std::string, std::size_t> landmarks;  ///< of the whole map, by label
  std::vector<map::Session> sessions;            ///< of the whole map; the last is this run
  std::optional<map::Level> level;               ///< of the whole map; none of a run that localizes in an old one
  std::optional<LiveMetrics> live;               ///< of a run on sensors
  double log_seconds = 0;                        ///< from first to last stamp
  double wall_seconds = 0;                       ///< of the whole run
  double way = 0;                                ///< [m] of this run's trajectory
};

/// What a user asks of one run.
struct RunRequest {
  std::vector<std::string> logs;  ///< rawlogs, merged by stamp
  bool live = false;              ///< instead of logs: the sensors of [live], until `stop`
  std::string replay;             ///< instead of logs: the journal of such a run, whose map is made again
  std::string output_folder;
  std::vector<std::string> more_outputs;  ///< sections of outputs beside those of the INI, such as the live window
  std::string continue_map;               ///< map file that the logs are a new session of; empty: a new map
  std::string localize_map;               ///< map file that the logs are only localized in, which stays as it is
  /// Workers for perception and jobs; the map does not depend on their number.
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  double speed = 0;     ///< times the log's own pace; 0: as fast as possible
  bool strict = false;  ///< a map that the run itself finds suspicious ends with its own code
  /// Told the result when all of a run that did not break off is written and a window still shows the map, before it is
  /// waited for; may be empty. The progress is not reported to after that.
  std::function<void(const RunResult&)> before_window_closes;
};

/// Log in, map out: opens the logs, makes the plugins, feeds the engine, writes the outputs. Damaged input and `stop`
/// still give the map of what was read, with their own code; nothing is written if that holds no key frame. The outputs
/// take the place of an older run's all together, or not at all; those of a run that was stopped, broke off, or could
/// not write all of them do so only where there was none, and else are in the folder "interrupted" in it. Throws
/// base::Error for everything that keeps a map from being written. `stop` is asked while the logs are
/// opened, between observations and while one is waited for; stopped while they are opened, it throws too. A live run
/// that is stopped is a whole one; it records into the folder "recording", and replaces checkpoint.omnimap from time to
/// time, in the output folder.
RunResult runMapping(const RunRequest& request, const base::Config& config, base::Progress& progress,
                     const std::function<bool()>& stop);

/// The summary for a screen, without the warnings.
std::string toText(const RunResult& result);

/// The sections of an INI that runMapping() reads beside those of the plugins.
const FixedSections& fixedSections();

}  // namespace omnimapper::mapper
