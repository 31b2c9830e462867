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

namespace omnimapper::mapper {

/// In the output folder, of a live run that goes on or crashed.
inline constexpr char kCheckpoint[] = "checkpoint.omnimap";

/// Where the observations of a run come from: logs, sensors, or what was recorded of sensors.
class Feed {
 public:
  using Stop = std::function<bool()>;

  virtual ~Feed() = default;

  /// Of the session that the run makes.
  virtual std::string title() const = 0;
  /// What is read, for messages.
  virtual std::string name() const = 0;
  /// Files that no output may replace.
  virtual std::vector<std::string> inputs() const { return {}; }
  /// When the engine is to take up what its workers make.
  virtual std::unique_ptr<Schedule> schedule() { return std::make_unique<Schedule>(); }
  /// Whether a run that `stop` ends is a whole one.
  virtual bool endsWhenStopped() const { return false; }

  /// Why the outputs must not take the place of a run's that is in this folder; empty if they may.
  virtual std::string keepsRunIn(const std::string& /*folder*/) const { return ""; }

  /// Opens what can be opened before there is a place for outputs; throws Error where that cannot be read.
  virtual void open(const Stop& stop) = 0;
  /// The folder of the outputs is there.
  virtual void begin(const std::string& /*output_folder*/, const Stop& /*stop*/) {}
  /// Gives all to the engine. True if `stop` ended it before its end.
  virtual bool feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) = 0;
  /// The outputs are in their places, in this folder.
  virtual void published(const std::string& /*output_folder*/) {}

  /// What was read until now.
  virtual source::SourceReport report() const = 0;
  /// What the program ends with if nothing else is wrong.
  virtual base::ExitCode code() const { return report().exitCode(); }
  /// Half a sentence for the user of a run that has no map: what of it was written all the same.
  virtual std::string whatStays() const { return "nothing was written"; }
  /// What to run where nothing could be mapped.
  virtual std::string checkHint() const { return "omnimapper-graphslam --check names the INIs that fit this log"; }
  /// Names in the output folder that are the feed's own.
  virtual std::vector<std::string> files() const { return {}; }
};

/// What the request asks for. Throws Error where the INI does not suit it.
std::unique_ptr<Feed> makeFeed(const RunRequest& request, const base::Config& config);

}  // namespace omnimapper::mapper
