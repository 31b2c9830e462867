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

/// Where the threads of all sensors leave their observations, and the mapper takes them: each is stamped, encoded once,
/// given to the recorder, and waits for the mapper in the same order.
class Arrivals {
 public:
  /// `recorder` may be null: nothing is recorded.
  Arrivals(const LiveOptions& options, std::unique_ptr<Recorder> recorder);

  /// From the thread of a sensor. `clock` is that sensor's alone; its observation is changed.
  void add(mrpt::obs::CObservation& observation, base::Stamp arrival, SensorClock& clock);
  /// An object of a driver that is no observation.
  void addOther(const std::string& class_name);

  /// The oldest that waits, as a reader of the recording would get it; waits so long for one.
  std::optional<LiveObservation> next(std::chrono::milliseconds patience);
  /// Lets go what waits, for nobody maps it; it counts as given.
  void discardWaiting();
  /// From now on nothing is taken any more.
  void close();
  /// Numbers of those that were left out since the last call, for newer ones of their cameras.
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
