#include "run/ReplayFeed.h"

#include <omnimapper/source/RawlogSource.h>

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

std::unique_ptr<Schedule> ReplayFeed::schedule() {
  return std::make_unique<ReplaySchedule>(cursor_);
}

void ReplayFeed::open(const Stop& stop) {
  cursor_->journal = live::Journal::read(path_);
  log_.emplace(source::openRawlogs({cursor_->journal.rawlogs.front()}, {}, stop), stop);
}

// The observation of that number; null at the end of the recording. Those between were left out.
mrpt::obs::CObservation::Ptr ReplayFeed::read(std::uint64_t number, const Stop& stop) {
  while (!stop()) {
    auto observation = log_->next();
    if (observation) {
      if (next_++ == number) return observation;
      continue;
    }
    if (log_->report().exitCode() != base::ExitCode::ok || file_ + 1 == cursor_->journal.rawlogs.size()) return nullptr;
    of_earlier_.add(log_->report());
    log_.emplace(source::openRawlogs({cursor_->journal.rawlogs[++file_]}, {}, stop), stop);
  }
  return nullptr;
}

bool ReplayFeed::feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) {
  auto& cursor = *cursor_;
  const auto& events = cursor.journal.events;
  while (cursor.next < events.size() && !stop()) {
    const auto event = events[cursor.next++];
    if (event.kind == EventKind::drop || (cursor.has_departed && event.kind != EventKind::add)) continue;
    if (event.kind != EventKind::add) {
      cursor.has_departed = true;
      engine.warn(path_ + ": with this INI the mapper does not do what it did live: from event " +
                  std::to_string(cursor.next) + " of the journal on the recording is mapped as a log");
      continue;
    }
    const auto observation = read(event.number, stop);
    if (!observation) {
      ended_early_ = !stop();
      break;
    }
    samples.add(observation);
    engine.add(observation);
    progress.report(static_cast<double>(cursor.next) / static_cast<double>(events.size()),
                    std::to_string(engine.view().map.key_frames.size()) + " key frames");
  }
  if (ended_early_)
    engine.warn(path_ +
                ": the recording ends before its journal does, as when its writer was killed: this is the map "
                "of what was recorded");
  return stop();
}

source::SourceReport ReplayFeed::report() const {
  auto report = of_earlier_;
  if (of_earlier_.objects == 0) report.ending = source::SourceReport::Ending::complete;
  auto of_last = log_->report();
  // Of the last file all that the journal speaks of was read.
  if (of_last.ending == source::SourceReport::Ending::open) of_last.ending = source::SourceReport::Ending::complete;
  report.add(of_last);
  return report;
}

}  // namespace omnimapper::mapper
