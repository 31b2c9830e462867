#include "run/LiveFeed.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Exceptions.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/live/Journal.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/source/SourceOptions.h>

#include <algorithm>
#include <cstdio>
#include <thread>

namespace omnimapper::mapper {

namespace {

using Kind = live::JournalEvent::Kind;
using std::chrono::milliseconds;

constexpr char kRecording[] = "recording";  // in the output folder

std::string times(std::uint64_t count) {
  if (count < 2) return count == 0 ? "never" : "once";
  return std::to_string(count) + " times";
}

// The keys of [source] in the INI that only apply to logs.
std::string keysForLogs(const base::Config& config) {
  std::string keys, text;
  for (const auto& spec : source::SourceOptions::table().specs())
    if (spec.key != "labels" && config.section("source").find(spec.key, text))
      keys += (keys.empty() ? "" : ", ") + spec.key;
  return keys;
}

}  // namespace

LiveFeed::LiveFeed(const live::LiveOptions& options, std::vector<std::string> labels, const base::Config& config,
                   ChangedConfig changed_config)
    : options_(options),
      labels_(std::move(labels)),
      unused_keys_(keysForLogs(config)),
      sections_(live::readSensors(options, config)),
      title_(live::nameByTime()),
      ini_(base::kWrittenFromALog + ": how " + title_ + ".rawlog was mapped while it was recorded.\n" + config.text()),
      name_("the sensors of " + config.file()),
      changed_config_(std::move(changed_config)) {}

void LiveFeed::begin(const std::string& output_folder, const Stop& stop) {
  checkpoints_.emplace(output_folder + "/" + kCheckpoint, options_.checkpoint);
  const std::string folder = output_folder + "/" + kRecording;
  std::unique_ptr<live::Recorder> recorder;
  if (options_.record) {
    recorder = std::make_unique<live::Recorder>(folder, title_, live::recorderOptions(options_));
  }
  sensors_ = std::make_unique<live::LiveSource>(sections_, options_, std::move(recorder));
  sensors_->open(stop);
  if (options_.record) {
    const std::string journal = folder + "/" + title_ + ".journal";
    trace_->journal.emplace(journal);
    base::writeFile(live::iniOf(journal), [&](std::ostream& out) { out << ini_; });
  }
  recording_ = options_.record ? folder : "";
}

bool LiveFeed::feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) {
  try {
    feedAll(engine, samples, progress, stop);
  } catch (...) {  // the map so far is finished without further observations
    sensors_->close();
    engine.setLive(metrics());
    throw;
  }
  warnOfSensors(engine);
  return false;
}

void LiveFeed::feedAll(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) {
  constexpr milliseconds kPatience(10), kBusy(2);
  const auto waitForWorkers = [&] {
    engine.poll();
    if (engine.isBusy()) std::this_thread::sleep_for(kBusy);
  };
  while (!stop()) {
    attend(engine, progress);
    if (engine.isBusy()) {
      waitForWorkers();
    } else if (!giveNext(engine, samples, kPatience)) {
      engine.poll();
    }
  }
  progress.reportState("ending: closing the sensors, and mapping what they have sent");
  sensors_->close();
  for (bool is_more = true; is_more;) {
    while (engine.isBusy()) waitForWorkers();
    is_more = giveNext(engine, samples, milliseconds(0));
  }
  has_ended_ = true;
  attended_ = flushed_ = {};
  attend(engine, progress);
}

// Passes the next observation to the engine. Returns false if there is none.
bool LiveFeed::giveNext(Engine& engine, SensorSamples& samples, milliseconds patience) {
  const auto take = [&] {
    const auto timer = engine.measure(Stage::source);
    return sensors_->next(patience);
  };
  const auto next = take();
  for (const auto number : sensors_->takeDropped()) trace_->note(Kind::drop, number);
  if (!next) return false;
  const auto& label = next->observation->sensorLabel;
  if (!labels_.empty() && std::find(labels_.begin(), labels_.end(), label) == labels_.end()) {
    ++filtered_out_;
    trace_->note(Kind::drop, next->number);
    return true;
  }
  trace_->note(Kind::add, next->number);
  samples.add(next->observation);
  engine.add(next->observation);
  return true;
}

// Handles everything beside mapping, several times a second: messages, checkpoints, journal, verdict and state line.
void LiveFeed::attend(Engine& engine, base::Progress& progress) {
  constexpr milliseconds kBetween(50), kBetweenFlushes(200);
  const auto now = Clock::now();
  if (now - attended_ < kBetween) return;
  attended_ = now;
  for (const auto& sentence : sensors_->takeNews()) progress.reportEvent(sentence);
  if (const auto problem = checkpoints_->offer(engine.view()); !problem.empty()) progress.reportEvent(problem);
  if (trace_->journal && now - flushed_ >= kBetweenFlushes) {
    flushed_ = now;
    if (!trace_->journal->flush() && !journal_has_failed_) {
      journal_has_failed_ = true;
      const std::string problem = "the journal of the recording cannot be written any more: a replay will end here";
      progress.reportEvent(problem);
      engine.warn(problem);
    }
  }
  if (!has_ended_) changePlugins(engine, progress);
  if (now >= next_judgement_ && !has_ended_) judge(engine);
  engine.setLive(metrics());
  progress.reportState(stateText(engine.view()));
}

// Lets plugins come and go if the user asks for it. The change is journalled with its INI before it is made, so that a
// replay does the same at the same place, even if the new plugins turn out not to fit the map.
void LiveFeed::changePlugins(Engine& engine, base::Progress& progress) {
  if (!changed_config_) return;
  std::optional<base::Config> config;
  PluginDifference difference;
  try {
    config = changed_config_();
    if (!config) return;
    difference = plugin_changer_.prepare(*config);
    if (difference.isNone()) return progress.reportEvent("the INI was read again: no plugin of it has changed");
    if (trace_->journal) writeChange(*config);
  } catch (const base::Error& error) {
    const std::string problem = "the plugins stay as they were: " + base::sentenceOf(error);
    progress.reportEvent(problem);
    engine.warn(problem);
    return;
  }
  trace_->note(Kind::plugins, ++changes_);
  progress.reportEvent(plugin_changer_.apply(std::move(difference), *config));
}

void LiveFeed::writeChange(const base::Config& config) const {
  const std::string journal = recording_ + "/" + title_ + ".journal";
  base::writeFile(live::iniOf(journal, changes_ + 1), [&](std::ostream& out) {
    out << base::kWrittenFromALog << ": change " << changes_ + 1 << " of the plugins during " << title_ << ".\n"
        << config.text();
  });
}

// Judges the map. The engine waits meanwhile, and the time this takes grows with the map, so the interval does as well.
void LiveFeed::judge(Engine& engine) {
  constexpr auto kShortest = std::chrono::seconds(5);
  constexpr int kShare = 200;  // at most 1/kShare of the time is spent on it
  const auto begin = Clock::now();
  engine.judge();
  next_judgement_ = Clock::now() + std::max<Clock::duration>(kShortest, kShare * (Clock::now() - begin));
}

// Adds a warning for each sensor that had problems; each single loss was already reported when it occurred.
void LiveFeed::warnOfSensors(Engine& engine) const {
  if (!unused_keys_.empty())
    engine.warn("these settings apply only to logs and have no effect on live sensors: [source] " + unused_keys_);
  if (filtered_out_ > 0)
    engine.warn("[source] labels left " + std::to_string(filtered_out_) +
                " observations out of the map; they are recorded");
  for (const auto& sensor : sensors_->sensors()) {
    std::string troubles;
    const auto add = [&](const std::string& trouble) { troubles += (troubles.empty() ? "" : "; ") + trouble; };
    if (sensor.observations == 0) {
      add("never sent anything that can be used");
    } else if (sensor.losses > 0) {
      add("was silent or lost " + times(sensor.losses) + ", and came back " + times(sensor.reopened) +
          (sensor.problem.empty() ? "" : " (last: " + sensor.problem + ")"));
    }
    if (sensor.left_out > 0)
      add("sent " + base::counted(sensor.left_out, "invalid message") + ", which " + base::wasOrWere(sensor.left_out) +
          " discarded");
    if (sensor.clock_jumps > 0) {
      char text[120];
      std::snprintf(text, sizeof text, "has another clock than the host: %.3f s are added to its latest stamps",
                    sensor.clock_offset);
      add(text);
    }
    if (!troubles.empty()) engine.warn("sensor [" + sensor.name + "] " + troubles);
  }
  const auto* recorder = sensors_->recorder();
  if (recorder && !recorder->failure().empty()) engine.warn(recorder->failure());
}

LiveMetrics LiveFeed::metrics() const {
  LiveMetrics metrics;
  for (const auto& sensor : sensors_->sensors())
    metrics.sensors.push_back({sensor.name, toString(sensor.state), sensor.observations, sensor.clock_offset,
                               sensor.clock_jumps, sensor.reopened, sensor.left_out});
  const auto counts = sensors_->counts();
  metrics.arrived = counts.arrived - filtered_out_;
  metrics.given = counts.given - filtered_out_;
  metrics.dropped = counts.dropped;
  metrics.not_kept = counts.not_kept;
  metrics.unusable = counts.unusable;
  metrics.latency_median = trace_->latencies.quantile(0.5);
  metrics.latency_99 = trace_->latencies.quantile(0.99);
  if (const auto* recorder = sensors_->recorder()) {
    for (const auto& file : recorder->files()) metrics.recording.push_back(std::string(kRecording) + "/" + file);
    const auto recorded = recorder->statistics();
    metrics.recorded = recorded.observations;
    metrics.recorded_bytes = recorded.bytes;
    metrics.bytes_on_disk = recorded.bytes_on_disk;
    metrics.recorder_seconds = recorded.seconds;
  }
  return metrics;
}

std::string LiveFeed::stateText(const View& view) const {
  const auto counts = sensors_->counts();
  char text[192];
  std::snprintf(text, sizeof text,
                "; %zu key frames, %zu closures; %.2f s late (99 %%: %.2f s), %llu waiting, %llu dropped",
                view.map.key_frames.size(), countClosures(view.decisions).accepted, trace_->latencies.quantile(0.5),
                trace_->latencies.quantile(0.99), static_cast<unsigned long long>(counts.waiting),
                static_cast<unsigned long long>(counts.dropped));
  const std::string verdict = view.verdict.evidence.empty() ? "" : "; map: " + toString(view.verdict.answer);
  return sensors_->sensorsText() + text + verdict;
}

source::SourceReport LiveFeed::report() const {
  auto report = sensors_->report();
  if (has_ended_) report.ending = source::SourceReport::Ending::complete;
  return report;
}

base::ExitCode LiveFeed::code() const {
  const auto* recorder = sensors_->recorder();
  const bool is_cut = (recorder && !recorder->failure().empty()) || journal_has_failed_;
  return is_cut ? base::ExitCode::disk_full : report().exitCode();
}

std::string LiveFeed::whatStays() const {
  return recording_.empty() ? Feed::whatStays() : "no map was written; the observations are recorded in " + recording_;
}

std::vector<std::string> LiveFeed::files() const {
  return {kRecording, kCheckpoint};
}

}  // namespace omnimapper::mapper
