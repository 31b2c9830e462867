#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/source/SourceReport.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "Engine.h"
#include "run/MissingExtractors.h"
#include "run/PluginDifference.h"

namespace omnimapper::mapper {

/// File in the output folder of a live run that is running or crashed.
inline constexpr char kCheckpoint[] = "checkpoint.omnimap";

/// The source of a run's observations: logs, sensors, or the recording of a live run.
class Feed {
 public:
  using Stop = std::function<bool()>;

  virtual ~Feed() = default;

  /// Title of the session that the run adds.
  virtual std::string title() const = 0;
  /// Name of the input, for messages.
  virtual std::string name() const = 0;
  /// Input files, which no output may overwrite.
  virtual std::vector<std::string> inputs() const { return {}; }
  /// The schedule by which the engine uses the results of its workers.
  virtual std::unique_ptr<Schedule> schedule() { return std::make_unique<Schedule>(); }
  /// Whether a run that is ended by `stop` counts as complete.
  virtual bool endsWhenStopped() const { return false; }

  /// Why the outputs must not replace those of the run in this folder: the rest of a sentence that begins with "the
  /// folder holds the map of an earlier run, and"; empty if they may.
  virtual std::string keepsRunIn(const std::string& /*folder*/) const { return ""; }

  /// Opens the inputs before the output folder exists; throws Error if they cannot be read.
  virtual void open(const Stop& stop) = 0;
  /// Called when the output folder exists.
  virtual void begin(const std::string& /*output_folder*/, const Stop& /*stop*/) {}
  /// Passes all observations to the engine. Returns true if `stop` ended it early.
  virtual bool feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) = 0;
  /// How the plugins of the engine become those of another INI.
  struct PluginChanger {
    /// Makes the new plugins. Throws base::Error if the INI does not allow it; the run is as before then.
    std::function<PluginDifference(const base::Config&)> prepare;
    /// Changes the plugins and returns a sentence on what changed, or on why they could not be changed. Throws what the
    /// work throws that is finished before.
    std::function<std::string(PluginDifference, const base::Config&)> apply;
  };
  /// Called before feed().
  void setPluginChanger(PluginChanger changer) { plugin_changer_ = std::move(changer); }

  /// Called when the outputs are in their final places in this folder.
  virtual void published(const std::string& /*output_folder*/) {}

  /// Report on the observations read so far.
  virtual source::SourceReport report() const = 0;
  /// Exit code of the program if nothing else is wrong.
  virtual base::ExitCode code() const { return report().exitCode(); }
  /// Clause for the user of a run without a map: what was written nevertheless.
  virtual std::string whatStays() const { return "nothing was written"; }
  /// Sentence for the user that names the command to try when nothing could be mapped.
  virtual std::string checkHint() const { return "omnimapper-graphslam --check names the INIs that fit this log"; }
  /// Names of files and folders in the output folder that belong to the feed.
  virtual std::vector<std::string> files() const { return {}; }

 protected:
  PluginChanger plugin_changer_;
};

/// Makes the feed that the request names. Throws Error if the INI does not suit it.
std::unique_ptr<Feed> makeFeed(const RunRequest& request, const base::Config& config);

}  // namespace omnimapper::mapper
