#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/Recorder.h>
#include <omnimapper/live/SensorClock.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/SourceReport.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::live {

/// The queue between the threads of all sensors and the mapper. Each observation is stamped, encoded once, given to the
/// recorder, and waits for the mapper in the same order.
class Arrivals {
 public:
  /// If `recorder` is null, nothing is recorded.
  Arrivals(const LiveOptions& options, std::unique_ptr<Recorder> recorder);

  /// Adds an observation, whose label and stamp are corrected; from the thread of its sensor. `clock` is that sensor's.
  void add(mrpt::obs::CObservation& observation, base::Stamp arrival, SensorClock& clock);
  /// Counts an object of a driver that is no observation.
  void addOther(const std::string& class_name);

  /// The oldest observation that waits, as a reader of the recording would get it; none if none comes within
  /// `patience`.
  std::optional<LiveObservation> next(std::chrono::milliseconds patience);
  /// Discards the observations that wait, if nobody maps them; they count as given.
  void discardWaiting();
  /// Ignores all observations from now on.
  void close();
  /// Numbers of observations that were left out since the last call because of newer ones of their cameras.
  std::vector<std::uint64_t> takeDropped();

  source::SourceReport report() const;
  LiveCounts counts() const;
  /// Null if nothing is recorded.
  Recorder* recorder() const { return recorder_.get(); }

 private:
  struct Waiting {
    std::uint64_t number;
    std::string label;
    bool is_camera;
    Encoded encoded;
  };
  void makeRoomFor(const std::string& label);
  std::optional<Waiting> takeFirst(std::chrono::milliseconds patience);

  const LiveOptions options_;
  const std::unique_ptr<Recorder> recorder_;

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  source::ObservationGate gate_;
  std::deque<Waiting> waiting_;
  std::vector<std::uint64_t> dropped_;
  std::uint64_t next_number_ = 0;
  bool is_closed_ = false;
  source::SourceReport report_;
  LiveCounts counts_;
};

}  // namespace omnimapper::live
