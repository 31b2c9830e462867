#pragma once

#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/SensorSection.h>

#include <chrono>
#include <optional>

#include "run/Checkpoints.h"
#include "run/Feed.h"
#include "run/LiveTrace.h"

namespace omnimapper::mapper {

/// Maps live sensors until the run is stopped.
class LiveFeed : public Feed {
 public:
  using ChangedConfig = std::function<std::optional<base::Config>()>;
  /// Only observations with one of `labels` are mapped, or all if it is empty. `changed_config`: see RunRequest. Throws
  /// Error as live::readSensors().
  LiveFeed(const live::LiveOptions& options, std::vector<std::string> labels, const base::Config& config,
           ChangedConfig changed_config = {});

  std::string title() const override { return title_; }
  std::string name() const override { return name_; }
  std::unique_ptr<Schedule> schedule() override { return std::make_unique<LiveSchedule>(trace_); }
  bool endsWhenStopped() const override { return true; }
  void open(const Stop&) override {}
  void begin(const std::string& output_folder, const Stop& stop) override;
  bool feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) override;
  void published(const std::string& output_folder) override { checkpoints_->removeFor(output_folder + "/map.omnimap"); }
  source::SourceReport report() const override;
  base::ExitCode code() const override;
  std::string whatStays() const override;
  // Unlike a run on a log, a live drive cannot be repeated, and Ctrl-C may end the next one after a second.
  std::string keepsRunIn(const std::string&) const override { return "a live run would replace it"; }
  std::string checkHint() const override { return "omnimapper-graphslam --check --live shows what the sensors send"; }
  std::vector<std::string> files() const override;

 private:
  using Clock = std::chrono::steady_clock;
  void feedAll(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop);
  bool giveNext(Engine& engine, SensorSamples& samples, std::chrono::milliseconds patience);
  void attend(Engine& engine, base::Progress& progress);
  void judge(Engine& engine);
  void changePlugins(Engine& engine, base::Progress& progress);
  void writeChange(const base::Config& config) const;
  void warnOfSensors(Engine& engine) const;
  LiveMetrics metrics() const;
  std::string stateText(const View& view) const;

  live::LiveOptions options_;
  std::vector<std::string> labels_;
  std::string unused_keys_;  // keys of [source] that have no effect
  std::vector<live::SensorSection> sections_;
  std::string title_, ini_, name_, recording_;  // recording_: its folder, empty without a recording
  std::shared_ptr<LiveTrace> trace_ = std::make_shared<LiveTrace>();
  std::unique_ptr<live::LiveSource> sensors_;
  std::optional<Checkpoints> checkpoints_;
  Clock::time_point attended_ = Clock::now(), flushed_ = attended_, next_judgement_ = attended_;
  ChangedConfig changed_config_;
  std::uint64_t changes_ = 0;       // of the plugins
  std::uint64_t filtered_out_ = 0;  // observations left out by [source] labels
  bool has_ended_ = false, journal_has_failed_ = false;
};

}  // namespace omnimapper::mapper
