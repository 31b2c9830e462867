#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/obs/registerAllClasses.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/describeInput.h>

#include <algorithm>
#include <atomic>
#include <deque>

#include "ActionSpans.h"
#include "ExternalFiles.h"
#include "ObjectReader.h"
#include "ObservationSelection.h"
#include "SandboxedReader.h"
#include "StepClock.h"

namespace omnimapper::source {

using mrpt::obs::CObservation;

namespace {

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

// What the child process does: reads each object and, in case that crashes, does with it what depends on its content.
bool readRawlog(const std::string& path, const SandboxedReader::Took& took) {
  ObjectReader reader(path);
  while (const auto object = reader.next()) {
    if (const auto* actions = dynamic_cast<const mrpt::obs::CActionCollection*>(object.get()))
      for (const auto& action : *actions) motionOf(action.get_ptr());
    if (!took()) return false;
  }
  return reader.ending() != ObjectReader::Ending::corrupt;
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
  Stream(const std::string& path, const SourceOptions& options, const StopOpening& stop, double clock_offset)
      : reader_(registeringClasses(path)),
        sandbox_([&](const SandboxedReader::Took& took) { return readRawlog(path, took); }),
        spans_(options.action_span, options.action_label),
        steps_(options.step),
        images_folder_(options.images_folder.empty() ? externalFolderOf(path) : options.images_folder),
        selection_(options, clock_offset,
                   [this](const CObservation& observation) { return loadExternalFiles(observation, images_folder_); }) {
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
    while (!selection_.isOver() && !interrupted_) {
      while (waiting_.empty() && readObject()) {
      }
      if (waiting_.empty()) break;
      const auto observation = waiting_.front();
      waiting_.pop_front();
      if (selection_.takes(*observation)) return observation;
    }
    return nullptr;
  }

  double progress() const { return selection_.isOver() ? 1.0 : reader_.file().fraction(); }

  SourceReport report() const {
    SourceReport report = report_;
    report.ending = waiting_.empty() ? endingOf(reader_.ending()) : SourceReport::Ending::open;
    report.message = reader_.message();
    report.unregistered_class = reader_.unregisteredClass();
    report.objects = reader_.objects();
    report.bytes = reader_.bytes();
    report.dropped_actions = spans_.dropped();
    return selection_.report(std::move(report));
  }

  std::optional<base::Stamp> firstStamp() const {
    for (const auto& observation : waiting_)
      if (base::isValid(observation->timestamp)) return selection_.corrected(*observation);
    return std::nullopt;
  }

  void setLogStart(base::Stamp log_start) { selection_.setLogStart(log_start); }
  void setGate(std::shared_ptr<ObservationGate> gate) { selection_.setGate(std::move(gate)); }
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

  ObjectReader reader_;
  SandboxedReader sandbox_;
  std::function<bool()> stop_waiting_;  // ends the wait for the child process
  std::atomic<bool> interrupted_{false};
  ActionSpans spans_;
  StepClock steps_;
  std::string images_folder_;
  ObservationSelection selection_;
  std::deque<CObservation::Ptr> waiting_;
  SourceReport report_;
  std::uint64_t rawlog_objects_ = 0;
};

RawlogSource::RawlogSource(const std::string& path, const SourceOptions& options, const StopOpening& stop,
                           double clock_offset)
    : stream_(std::make_unique<Stream>(path, options, stop, clock_offset)) {}
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

}  // namespace omnimapper::source
