#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/obs/registerAllClasses.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/source/MergedSource.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/RawlogSource.h>

#include <algorithm>
#include <atomic>
#include <deque>

#include "ActionSpans.h"
#include "ExternalFiles.h"
#include "ObjectReader.h"
#include "ObservationFilter.h"
#include "SandboxedReader.h"
#include "SensorClocks.h"
#include "StepClock.h"
#include "describeInput.h"

namespace omnimapper::source {

using mrpt::obs::CObservation;

namespace {

// After so many observations in a row beyond the end of the wanted time, the rest of the log is not read.
constexpr int kEnoughAfterTheEnd = 1000;

std::string registeringClasses(const std::string& path) {
  mrpt::obs::registerAllClasses_mrpt_obs();
  mrpt::maps::registerAllClasses_mrpt_maps();
  obs::registerClasses();
  return path;
}

// Latest stamp of a frame's observations; "no stamp" if none has one.
base::Stamp stampOf(const mrpt::obs::CSensoryFrame& frame) {
  base::Stamp latest;
  for (const auto& observation : frame)
    if (observation && base::isValid(observation->timestamp)) latest = std::max(latest, observation->timestamp);
  return latest;
}

// What is done with each object, as far as it depends on its content. The child process does it first, in case it
// crashes.
void useOnce(mrpt::serialization::CSerializable& object) {
  if (const auto* actions = dynamic_cast<const mrpt::obs::CActionCollection*>(&object))
    for (const auto& action : *actions) motionOf(action.get_ptr());
}

SourceReport::Ending endingOf(ObjectReader::Ending ending) {
  switch (ending) {
    case ObjectReader::Ending::open:
      return SourceReport::Ending::open;
    case ObjectReader::Ending::complete:
      return SourceReport::Ending::complete;
    case ObjectReader::Ending::truncated:
      return SourceReport::Ending::truncated;
    case ObjectReader::Ending::corrupt:
      return SourceReport::Ending::corrupt;
    case ObjectReader::Ending::unregistered_class:
      return SourceReport::Ending::unregistered_class;
  }
  return SourceReport::Ending::corrupt;
}

}  // namespace

class RawlogSource::Stream {
 public:
  Stream(const std::string& path, const SourceOptions& options, const StopOpening& stop)
      : reader_(registeringClasses(path)),
        sandbox_(path, useOnce),
        spans_(options.action_span, options.action_label),
        steps_(options.step),
        filter_(options),
        images_folder_(options.images_folder.empty() ? externalFolderOf(path) : options.images_folder) {
    bool stopped = false;
    stop_waiting_ = [&] { return stopped = stopped || (stop && stop()); };
    if (!stop_waiting_()) {
      reader_.ask([this](std::uint64_t objects) { return sandbox_.mayReadAfter(objects, stop_waiting_); });
    }
    while (!stopped && waiting_.empty() && readObject()) {
    }
    if (stopped) throw base::Error(base::ExitCode::interrupted, path + ": interrupted while the log was being opened.");
    stop_waiting_ = [this] { return interrupted_.load(); };
    if (reader_.objects() == 0 && !reader_.sawHeader() && reader_.ending() != ObjectReader::Ending::complete)
      refuse(describeInput(path));
    if (waiting_.empty() && reader_.objects() > 0 && rawlog_objects_ == 0)
      refuse("is no rawlog: it holds an object of class " + report_.other_objects.begin()->first +
             ", but no observation, action or sensory frame.");
  }

  CObservation::Ptr next() {
    while (!is_over_ && !interrupted_) {
      while (waiting_.empty() && readObject()) {
      }
      if (waiting_.empty()) break;
      const auto observation = waiting_.front();
      waiting_.pop_front();
      observation->sensorLabel = base::sensorName(observation->sensorLabel);
      if (!clocks_.concerns(*observation)) continue;
      clocks_.correct(*observation);
      if (!passes(*observation)) continue;
      report_.count(observation->sensorLabel, observation->GetRuntimeClass()->className, observation->timestamp);
      return observation;
    }
    return nullptr;
  }

  double progress() const { return is_over_ ? 1.0 : reader_.file().fraction(); }

  SourceReport report() const {
    SourceReport report = report_;
    report.ending = is_over_           ? SourceReport::Ending::complete
                    : waiting_.empty() ? endingOf(reader_.ending())
                                       : SourceReport::Ending::open;
    report.message = reader_.message();
    report.unregistered_class = reader_.unregisteredClass();
    report.objects = reader_.objects();
    report.bytes = reader_.bytes();
    report.dropped_actions = spans_.dropped();
    if (!clocks_.areFirst()) {  // another reader of the same log counts these
      report.objects = report.bytes = report.dropped_actions = report.repaired_stamps = 0;
      report.other_objects.clear();
    }
    return report;
  }

  std::optional<base::Stamp> firstStamp() const {
    for (const auto& observation : waiting_)
      if (base::isValid(observation->timestamp)) return clocks_.corrected(*observation);
    return std::nullopt;
  }

  void setLogStart(base::Stamp log_start) { filter_.setLogStart(log_start); }
  void setGate(std::shared_ptr<ObservationGate> gate) { gate_ = std::move(gate); }
  void setClocks(SensorClocks clocks) { clocks_ = std::move(clocks); }
  void interrupt() { interrupted_ = true; }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw base::Error(base::ExitCode::unreadable_input, reader_.file().path() + ": " + reason);
  }

  // Appends the observations of the next object to waiting_. Returns false at the end.
  bool readObject() {
    const auto object = reader_.next();
    if (!object) {
      if (reader_.ending() != ObjectReader::Ending::open) spans_.finish();
      return false;
    }
    ++rawlog_objects_;
    if (const auto actions = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
      steps_.stamp(*actions);
      for (const auto& motion : spans_.addAction(*actions)) waiting_.push_back(motion);
    } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
      steps_.stamp(*frame);
      addFrame(*frame);
    } else if (std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(object)) {
      ++report_.other_objects[object->GetRuntimeClass()->className];
    } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(object)) {
      steps_.stamp(*observation);
      waiting_.push_back(observation);
    } else {
      --rawlog_objects_;
      ++report_.other_objects[object->GetRuntimeClass()->className];
    }
    return true;
  }

  void addFrame(const mrpt::obs::CSensoryFrame& frame) {
    base::Stamp stamp = stampOf(frame);
    if (!base::isValid(stamp)) stamp = spans_.pendingStamp();
    for (const auto& motion : spans_.addFrame(stamp)) waiting_.push_back(motion);
    for (const auto& observation : frame) {
      if (!observation) continue;
      if (!base::isValid(observation->timestamp) && base::isValid(stamp)) {
        observation->timestamp = stamp;
        ++report_.repaired_stamps;
      }
      waiting_.push_back(observation);
    }
  }

  bool passes(const CObservation& observation) {
    if (!filter_.knowsLogStart() && base::isValid(observation.timestamp)) filter_.setLogStart(observation.timestamp);
    after_the_end_ = filter_.isAfterTheEnd(observation) ? after_the_end_ + 1 : 0;
    if (after_the_end_ >= kEnoughAfterTheEnd) is_over_ = true;
    if (!filter_.wants(observation)) {
      ++report_.filtered_out;
      report_.filtered_labels.insert(observation.sensorLabel);
      return false;
    }
    if (const auto missing = loadExternalFiles(observation, images_folder_)) {
      if (report_.missing_images++ == 0) report_.first_missing_image = *missing;
      return false;
    }
    if (const auto reason = gate_->refuses(observation)) {
      report_.countUnusable(observation.sensorLabel, *reason, observation.timestamp);
      return false;
    }
    return true;
  }

  ObjectReader reader_;
  SandboxedReader sandbox_;
  std::function<bool()> stop_waiting_;  // ends the wait for the child process
  std::atomic<bool> interrupted_{false};
  ActionSpans spans_;
  StepClock steps_;
  ObservationFilter filter_;
  std::string images_folder_;
  std::shared_ptr<ObservationGate> gate_ = std::make_shared<ObservationGate>();
  SensorClocks clocks_;
  std::deque<CObservation::Ptr> waiting_;
  SourceReport report_;
  std::uint64_t rawlog_objects_ = 0;
  int after_the_end_ = 0;  // number of observations in a row after the wanted time
  bool is_over_ = false;   // everything wanted has been read
};

RawlogSource::RawlogSource(const std::string& path, const SourceOptions& options, const StopOpening& stop)
    : stream_(std::make_unique<Stream>(path, options, stop)) {}
RawlogSource::~RawlogSource() = default;

CObservation::Ptr RawlogSource::next() {
  return stream_->next();
}
double RawlogSource::progress() const {
  return stream_->progress();
}
SourceReport RawlogSource::report() const {
  return stream_->report();
}
void RawlogSource::interrupt() {
  stream_->interrupt();
}
std::optional<base::Stamp> RawlogSource::firstStamp() const {
  return stream_->firstStamp();
}
void RawlogSource::setLogStart(base::Stamp log_start) {
  stream_->setLogStart(log_start);
}

void RawlogSource::setGate(std::shared_ptr<ObservationGate> gate) {
  stream_->setGate(std::move(gate));
}

std::unique_ptr<ObservationSource> openRawlogs(const std::vector<std::string>& paths, const SourceOptions& options,
                                               const StopOpening& stop) {
  if (paths.empty()) throw base::Error(base::ExitCode::command_line, "no rawlog is named; give one with -r.");
  std::vector<std::unique_ptr<RawlogSource>> logs;
  std::optional<base::Stamp> start;
  for (const auto& path : paths) {
    for (const double offset : SensorClocks::offsetsIn(options.clock_offsets)) {
      logs.push_back(std::make_unique<RawlogSource>(path, options, stop));
      logs.back()->stream_->setClocks({options.clock_offsets, offset});
    }
    const auto first = logs.back()->firstStamp();
    if (first && (!start || *first < *start)) start = first;
  }
  if (start && options.time_reference == TimeReference::log_start)
    for (auto& log : logs) log->setLogStart(*start);
  if (logs.size() == 1) return std::move(logs.front());
  return std::make_unique<MergedSource>(std::vector<std::unique_ptr<ObservationSource>>(
      std::make_move_iterator(logs.begin()), std::make_move_iterator(logs.end())));
}

}  // namespace omnimapper::source
