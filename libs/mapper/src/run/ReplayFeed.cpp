#include "run/ReplayFeed.h"

#include <omnimapper/base/Exceptions.h>
#include <omnimapper/base/IniDifferences.h>
#include <omnimapper/source/RawlogSource.h>

#include <algorithm>
#include <filesystem>

namespace omnimapper::mapper {

namespace {

using EventKind = live::JournalEvent::Kind;

}  // namespace

bool ReplaySchedule::takes(EventKind kind) {
  const bool is_next = cursor_->isNext(kind);
  cursor_->next += is_next;
  return is_next;
}

bool ReplaySchedule::takesBundleBeforeEnd(const FrameBundle&, std::size_t waiting) {
  return cursor_->has_departed ? waiting > kPipelineDepth : takes(EventKind::bundle);
}

bool ReplaySchedule::takesJobBeforeEnd(bool is_due, bool) {
  return cursor_->has_departed ? is_due : takes(EventKind::job);
}

std::string ReplayFeed::title() const {
  return std::filesystem::path(path_).stem().string();
}

std::vector<std::string> ReplayFeed::inputs() const {
  auto inputs = cursor_->journal.rawlogs;
  inputs.push_back(path_);
  return inputs;
}

// The live run's own outputs must not be replaced: only they say how it went, with its sensors, dropped observations
// and latencies.
std::string ReplayFeed::keepsRunIn(const std::string& folder) const {
  const auto recording = std::filesystem::absolute(path_).parent_path();
  std::error_code ignored;
  const bool is_there = std::filesystem::equivalent(recording, folder, ignored) ||
                        std::filesystem::equivalent(recording.parent_path(), folder, ignored);
  return is_there ? "that run is the live run that is replayed" : "";
}

std::unique_ptr<Schedule> ReplayFeed::schedule() {
  return std::make_unique<ReplaySchedule>(cursor_);
}

void ReplayFeed::open(const Stop& stop) {
  cursor_->journal = live::Journal::read(path_);
  of_earlier_.ending = source::SourceReport::Ending::complete;
  openFile(stop);
}

void ReplayFeed::openFile(const Stop& stop) {
  auto file = std::make_unique<source::RawlogSource>(cursor_->journal.rawlogs[file_], source::SourceOptions(), stop);
  file->setGate(gate_);
  log_.emplace(std::move(file), stop);
}

// Reads up to the observation of that number, and skips those between, which were left out; null at the end of the
// recording.
mrpt::obs::CObservation::Ptr ReplayFeed::read(std::uint64_t number, const Stop& stop) {
  while (!stop()) {
    auto observation = log_->next();
    if (observation) {
      if (next_++ == number) return observation;
      continue;
    }
    const bool is_whole = log_->report().ending == source::SourceReport::Ending::complete;
    if (!is_whole || file_ + 1 == cursor_->journal.rawlogs.size()) return nullptr;
    of_earlier_.add(log_->report());
    ++file_;
    openFile(stop);
  }
  return nullptr;
}

void ReplayFeed::depart(Engine& engine) {
  auto& cursor = *cursor_;
  if (cursor.has_departed) return;
  cursor.has_departed = true;
  engine.warn(path_ + ": this run departs from the live run at line " + std::to_string(cursor.next + 1) +
              " of the journal (is the INI, or the map that it continues, a different one?); from there on the "
              "recording is mapped like a log");
}

// Older recordings have no INI to compare with.
void ReplayFeed::warnOfOtherSettings(Engine& engine) {
  constexpr std::size_t kMostNamed = 5;
  std::vector<std::string> differences;
  try {
    const auto of_live_run = live::findIni(path_);
    if (of_live_run) differences = base::iniDifferences(ini_, base::Config::fromFile(*of_live_run).text());
  } catch (const base::Error& error) {
    engine.warn("the settings cannot be compared with those of the live run: " + base::sentenceOf(error));
  }
  if (differences.empty()) return;
  has_other_settings_ = true;
  std::string text;
  for (std::size_t i = 0; i < std::min(differences.size(), kMostNamed); ++i)
    text += (i > 0 ? ", " : "") + differences[i];
  if (differences.size() > kMostNamed) text += " and " + std::to_string(differences.size() - kMostNamed) + " more";
  engine.warn("the settings differ from those of the live run, so the map may differ: " + text);
}

bool ReplayFeed::feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) {
  warnOfOtherSettings(engine);
  auto& cursor = *cursor_;
  const auto& events = cursor.journal.events;
  while (cursor.next < events.size() && !stop()) {
    const auto event = events[cursor.next++];
    if (event.kind == EventKind::add || event.kind == EventKind::drop)
      first_unmentioned_ = std::max(first_unmentioned_, event.number + 1);
    if (event.kind == EventKind::drop) continue;
    if (event.kind == EventKind::plugins) {
      changePlugins(event.number, engine);
      continue;
    }
    // The run departs if the journal has an event that the engine did not cause, or lacks one: a live run adds no
    // observation while the engine is busy.
    if (event.kind != EventKind::add || engine.isBusy()) depart(engine);
    if (event.kind != EventKind::add) continue;
    const auto observation = [&] {
      const auto timer = engine.measure(Stage::source);
      return read(event.number, stop);
    }();
    if (!observation) {
      ended_early_ = !stop();
      break;
    }
    samples.add(observation);
    engine.add(observation);
    progress.report(static_cast<double>(cursor.next) / static_cast<double>(events.size()),
                    std::to_string(engine.view().map.key_frames.size()) + " key frames");
  }
  if (!ended_early_ && !stop()) mapWhatIsLeft(engine, samples, stop);
  if (ended_early_)
    engine.warn(path_ +
                ": the recording ends before its journal, as happens when the program was killed: the map contains "
                "what was recorded");
  return stop();
}

// Changes the plugins as the live run did, unless this run has settings of its own.
void ReplayFeed::changePlugins(std::uint64_t number, Engine& engine) {
  const std::string which = "change " + std::to_string(number) + " of the plugins during the live run";
  if (has_other_settings_) {
    engine.warn(which + " is left out, because this run has other settings");
    return depart(engine);
  }
  const auto ini = live::findIni(path_, number);
  if (!ini) {
    throw base::Error(base::ExitCode::unreadable_input,
                      live::iniOf(path_, number) + ": the INI of " + which + " is missing beside the journal");
  }
  try {
    const auto config = base::Config::fromFile(*ini);
    auto difference = plugin_changer_.prepare(config);
    plugin_changer_.apply(std::move(difference), config);
  } catch (const base::Error& error) {
    engine.warn(which + " is left out: " + base::sentenceOf(error));
    depart(engine);
  }
}

// Maps the observations after the end of a journal that was cut off.
void ReplayFeed::mapWhatIsLeft(Engine& engine, SensorSamples& samples, const Stop& stop) {
  std::uint64_t count = 0;
  for (auto observation = read(std::max(next_, first_unmentioned_), stop); observation;
       observation = read(next_, stop), ++count) {
    cursor_->has_departed = true;
    samples.add(observation);
    engine.add(observation);
  }
  if (count > 0)
    engine.warn(path_ + ": the journal ends " + std::to_string(count) +
                " observations before its recording: they are mapped like a log");
}

source::SourceReport ReplayFeed::report() const {
  auto report = of_earlier_;
  auto of_last = log_->report();
  // All observations of the last file that the journal mentions were read.
  if (of_last.ending == source::SourceReport::Ending::open) of_last.ending = source::SourceReport::Ending::complete;
  report.add(of_last);
  return report;
}

}  // namespace omnimapper::mapper
