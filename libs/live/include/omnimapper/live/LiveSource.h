#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/Recorder.h>
#include <omnimapper/live/SensorSection.h>
#include <omnimapper/source/SourceReport.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::live {

/// What the mapper is given.
struct LiveObservation {
  mrpt::obs::CObservation::Ptr observation;
  std::uint64_t number = 0;  ///< among the usable ones of the recording, from 0 on
};

/// How many observations went where; each of `arrived` is in one of the others or waits.
struct LiveCounts {
  std::uint64_t arrived = 0;   ///< from the drivers
  std::uint64_t given = 0;     ///< to the mapper
  std::uint64_t dropped = 0;   ///< for a newer frame of the same camera
  std::uint64_t not_kept = 0;  ///< frames of cameras that neither were recorded nor mapped: the disk was too slow
  std::uint64_t unusable = 0;  ///< recorded, and nothing can be made of them
  std::uint64_t waiting = 0;
};

/// How one sensor is.
struct SensorMetrics {
  enum class State { opening, working, silent, lost, stopped };

  std::string name;  ///< of its section
  State state = State::opening;
  std::uint64_t observations = 0;
  double rate = 0;          ///< [Hz] over the last seconds
  double clock_offset = 0;  ///< [s] that is added to its stamps
  std::size_t clock_jumps = 0;
  std::size_t losses = 0;      ///< how often it fell silent or was lost
  std::size_t reopened = 0;    ///< how often it came back
  std::uint64_t left_out = 0;  ///< messages or lines that its driver rejected as invalid, where it checks them
  std::string problem;         ///< why it was lost the last time, in the driver's words; empty if it never was
};

std::string toString(SensorMetrics::State state);

/// The sensors of a live run, each read by a thread of its own through its MRPT driver.
class LiveSource {
 public:
  /// Opens nothing yet. `recorder` may be null: nothing is recorded.
  LiveSource(std::vector<SensorSection> sensors, const LiveOptions& options, std::unique_ptr<Recorder> recorder);
  /// As close().
  ~LiveSource();
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  /// Opens the sensors in their order. Throws Error(unreadable_input), naming section and reason, if one cannot be
  /// opened or takes longer than 30 s for it, and Error(interrupted) if `stop` says so; then all are closed, and a
  /// recording of nothing is removed.
  void open(const std::function<bool()>& stop);
  /// Stops the sensors in reverse order, and ends the recording. A driver that does not return within two seconds is
  /// left behind; its process must end without waiting for it.
  void close();
  /// Whether close() had to leave a driver behind.
  bool hasLeftBehind() const;

  /// The next observation for the mapper; none if there is none within that time.
  std::optional<LiveObservation> next(std::chrono::milliseconds patience);
  /// Lets go what waits for the mapper, where nobody maps; it counts as given.
  void discardWaiting();
  /// Numbers of observations that were dropped since the last call.
  std::vector<std::uint64_t> takeDropped();
  /// One sentence for each thing that happened since the last call: a sensor fell silent, was lost, is back, its clock
  /// jumped; the recording ended early.
  std::vector<std::string> takeNews();

  std::vector<SensorMetrics> sensors() const;
  LiveCounts counts() const;
  /// A few words for a line of a screen: each sensor with its rate, or how it is.
  std::string sensorsText() const;
  /// Observations by label and class, as of a log.
  source::SourceReport report() const;
  /// Null if nothing is recorded.
  const Recorder* recorder() const;

 private:
  struct Parts;
  void openAll(const std::function<bool()>& stop);

  std::unique_ptr<Parts> parts_;
};

}  // namespace omnimapper::live
