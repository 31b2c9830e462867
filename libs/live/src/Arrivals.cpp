#include "Arrivals.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <omnimapper/base/Names.h>

#include <algorithm>
#include <utility>

namespace omnimapper::live {

namespace {

// Whether an observation is large and may be left out because of a newer one.
bool isOfCamera(const mrpt::obs::CObservation& observation) {
  using namespace mrpt::obs;
  return dynamic_cast<const CObservation3DRangeScan*>(&observation) ||
         dynamic_cast<const CObservationImage*>(&observation) ||
         dynamic_cast<const CObservationStereoImages*>(&observation) ||
         dynamic_cast<const CObservationPointCloud*>(&observation) ||
         dynamic_cast<const CObservationVelodyneScan*>(&observation) ||
         dynamic_cast<const CObservationRotatingScan*>(&observation);
}

}  // namespace

Arrivals::Arrivals(const LiveOptions& options, std::unique_ptr<Recorder> recorder)
    : options_(options), recorder_(std::move(recorder)) {}

void Arrivals::add(mrpt::obs::CObservation& observation, base::Stamp arrival, SensorClock& clock) {
  observation.sensorLabel = base::sensorName(observation.sensorLabel);
  observation.timestamp = clock.corrected(observation.timestamp, arrival);
  const Encoded encoded = encode(observation);
  const bool is_camera = isOfCamera(observation);
  {
    const std::lock_guard lock(mutex_);
    if (is_closed_) return;
    ++counts_.arrived;
    if (is_camera && recorder_ && !recorder_->hasRoomFor(encoded->size())) {
      ++counts_.not_kept;
      return;
    }
    if (recorder_) recorder_->add(encoded);
    if (const auto reason = gate_.refuses(observation)) {
      ++counts_.unusable;
      report_.countUnusable(observation.sensorLabel, *reason, observation.timestamp);
      return;
    }
    report_.count(observation.sensorLabel, observation.GetRuntimeClass()->className, observation.timestamp);
    ++report_.objects;
    report_.bytes += encoded->size();
    if (is_camera) makeRoomFor(observation.sensorLabel);
    waiting_.push_back({next_number_++, observation.sensorLabel, is_camera, encoded});
  }
  arrived_.notify_one();
}

// Drops the oldest frame of a camera if camera_queue frames of it wait.
void Arrivals::makeRoomFor(const std::string& label) {
  const auto is_alike = [&](const Waiting& one) { return one.is_camera && one.label == label; };
  const auto waiting = std::count_if(waiting_.begin(), waiting_.end(), is_alike);
  if (waiting < options_.camera_queue) return;
  const auto oldest = std::find_if(waiting_.begin(), waiting_.end(), is_alike);
  dropped_.push_back(oldest->number);
  ++counts_.dropped;
  waiting_.erase(oldest);
}

void Arrivals::addOther(const std::string& class_name) {
  const std::lock_guard lock(mutex_);
  ++report_.other_objects[class_name];
}

std::optional<Arrivals::Waiting> Arrivals::takeFirst(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (!arrived_.wait_for(lock, patience, [this] { return !waiting_.empty(); })) return std::nullopt;
  Waiting first = std::move(waiting_.front());
  waiting_.pop_front();
  ++counts_.given;
  return first;
}

// An observation whose class can be encoded but not read again is left out; the others are not affected.
std::optional<LiveObservation> Arrivals::next(std::chrono::milliseconds patience) {
  while (const auto first = takeFirst(patience)) {
    try {
      return LiveObservation{decode(first->encoded), first->number};
    } catch (const std::exception&) {
      const std::lock_guard lock(mutex_);
      --counts_.given;
      ++counts_.unusable;
      report_.countUnusable(first->label, "they cannot be read again from their recording", base::Stamp());
    }
  }
  return std::nullopt;
}

void Arrivals::discardWaiting() {
  const std::lock_guard lock(mutex_);
  counts_.given += waiting_.size();
  waiting_.clear();
}

void Arrivals::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
}

std::vector<std::uint64_t> Arrivals::takeDropped() {
  const std::lock_guard lock(mutex_);
  return std::exchange(dropped_, {});
}

source::SourceReport Arrivals::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

LiveCounts Arrivals::counts() const {
  const std::lock_guard lock(mutex_);
  LiveCounts counts = counts_;
  counts.waiting = waiting_.size();
  return counts;
}

}  // namespace omnimapper::live
