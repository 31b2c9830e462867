#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/PluginHelp.h>
#include <omnimapper/plugin/LiveMetrics.h>
#include <omnimapper/plugin/Verdict.h>
#include <omnimapper/source/SourceReport.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
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
  std::string output_folder;                ///< where the outputs are: the requested folder or one inside it
  bool took_place = false;                  ///< the outputs replaced those of an earlier run
  std::vector<std::string> foreign_files;   ///< other files in the requested folder, which no run wrote
  std::size_t key_frames = 0, factors = 0;  ///< of the whole map
  std::size_t new_key_frames = 0, closures = 0, refused_closures = 0;
  std::size_t localized = 0, located = 0;  ///< in a run that localizes: key frames, and those located in the map
  bool awaits_confirmation = false;        ///< one match locates the run in the map, but no second match confirms this
  std::map<std::string, std::size_t> landmarks;  ///< of the whole map, by label
  std::vector<map::Session> sessions;            ///< of the whole map; the last one is this run
  std::optional<map::Level> level;               ///< of the whole map; none if the run only localizes
  std::optional<LiveMetrics> live;               ///< only of a live run on sensors
  double log_seconds = 0;                        ///< from first to last stamp
  double mapping_seconds = 0;                    ///< wall time until the map was finished, before the outputs
  double wall_seconds = 0;                       ///< of the whole run
  double travel = 0;                             ///< [m] distance travelled in this run
};

/// Looks at the observations of a log beside the mapper, and judges them after the last one.
class InputWatch {
 public:
  virtual ~InputWatch() = default;
  /// Takes an observation as the source hands it out. It must not be changed.
  virtual void add(const mrpt::obs::CObservation::Ptr& observation) = 0;
  /// Evidence against a map of these observations, for the verdict, and sentences to warn with.
  struct Judgement {
    std::vector<Evidence> evidence;
    std::vector<std::string> warnings;
  };
  virtual Judgement judgement() = 0;
};

/// What a user requests of one run.
struct RunRequest {
  std::vector<std::string> logs;  ///< rawlogs, merged by stamp
  bool live = false;              ///< reads the sensors of [live] until `stop`, instead of logs
  std::string replay;             ///< journal of a live run to repeat, instead of logs
  std::string output_folder;
  std::vector<std::string> more_outputs;  ///< output sections beside those of the INI, such as the live window's
  std::string continue_map;               ///< map file to which the logs add a session; empty: a new map
  std::string localize_map;               ///< map file in which the logs are only localized; it is not changed
  /// Number of worker threads for perception and jobs; the map does not depend on it.
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  double speed = 0;                   ///< relative to the log's own speed; 0: as fast as possible
  std::shared_ptr<InputWatch> watch;  ///< of the observations of `logs`; none if null
  /// Called several times a second in a live run. If it returns an INI, the plugins that this INI adds, removes or
  /// gives other settings come and go while the run goes on; its other settings are not used. May be empty.
  std::function<std::optional<base::Config>()> changed_config;
  bool strict = false;  ///< if the run's verdict on its map is suspicious, it ends with its own exit code
  /// Called with the result if the run did not break off and a window still shows the map: after all outputs are
  /// written and before the run waits for the window to close. May be empty. No progress is reported after this call.
  std::function<void(const RunResult&)> before_window_closes;
};

/// Makes a map of logs: opens them, makes the plugins, feeds the engine and writes the outputs. After damaged input or
/// `stop`, it still writes the map of what was read and returns the exit code of the cause; it writes nothing if that
/// map has no key frame. The outputs replace all outputs of an older run in the folder, or none of them: if the run was
/// stopped, broke off or could not write every output, the older outputs stay, and the new outputs go to the subfolder
/// "interrupted". Throws base::Error for everything that prevents a map from being written. `stop` is called while the
/// logs are opened, between observations and while waiting for one; a stop while the logs are opened throws, too. A
/// live run that is stopped counts as complete. In the output folder, a live run records into the folder "recording"
/// and regularly replaces checkpoint.omnimap.
RunResult runMapping(const RunRequest& request, const base::Config& config, base::Progress& progress,
                     const std::function<bool()>& stop);

/// The summary to print on a terminal, without the warnings.
std::string toText(const RunResult& result);

/// The sections of an INI that runMapping() reads in addition to those of the plugins.
const FixedSections& fixedSections();

}  // namespace omnimapper::mapper
