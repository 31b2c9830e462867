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

/// An observation that is given to the mapper.
struct LiveObservation {
  mrpt::obs::CObservation::Ptr observation;
  std::uint64_t number = 0;  ///< index among the usable observations of the recording
};

/// Counts of observations by what became of them. Each observation of `arrived` is in exactly one of the other counts.
struct LiveCounts {
  std::uint64_t arrived = 0;   ///< from the drivers
  std::uint64_t given = 0;     ///< to the mapper
  std::uint64_t dropped = 0;   ///< left out because of a newer frame of the same camera
  std::uint64_t not_kept = 0;  ///< camera frames that were neither recorded nor mapped, because the disk was too slow
  std::uint64_t unusable = 0;  ///< recorded, but they cannot be mapped
  std::uint64_t waiting = 0;
};

/// State and statistics of one sensor.
struct SensorMetrics {
  enum class State { opening, working, silent, lost, stopped };

  std::string name;  ///< of its section
  State state = State::opening;
  std::uint64_t observations = 0;
  bool sends_on_request = false;  ///< only what somebody asks for: its silence is no trouble
  double rate = 0;                ///< [Hz] over the last seconds
  double clock_offset = 0;        ///< [s] offset that is added to the driver's stamps
  std::size_t clock_jumps = 0;
  std::size_t losses = 0;      ///< how often it fell silent or was lost
  std::size_t reopened = 0;    ///< how often it sent data again after that
  std::uint64_t left_out = 0;  ///< messages or lines that its driver rejected as invalid, if it checks them
  std::string problem;         ///< why it was lost the last time, as its driver reported; empty if it was never lost
};

std::string toString(SensorMetrics::State state);

/// The sensors of a live run, each read by a separate thread through its MRPT driver.
class LiveSource {
 public:
  /// Opens nothing yet. If `recorder` is null, nothing is recorded.
  LiveSource(std::vector<SensorSection> sensors, const LiveOptions& options, std::unique_ptr<Recorder> recorder);
  /// Calls close().
  ~LiveSource();
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  /// Opens the sensors in their order. Throws Error(unreadable_input), naming section and reason, if a sensor cannot be
  /// opened within 30 s, and Error(interrupted) if `stop` returns true. Before it throws, it closes all sensors and
  /// removes an empty recording.
  void open(const std::function<bool()>& stop);
  /// Stops the sensors in reverse order, and ends the recording. A driver that does not return within two seconds is
  /// left running; the process must then end without waiting for that driver.
  void close();
  /// Whether close() had to leave a driver running.
  bool hasLeftBehind() const;

  /// The next observation for the mapper; none if there is none within `patience`.
  std::optional<LiveObservation> next(std::chrono::milliseconds patience);
  /// Discards the observations that wait for the mapper, for runs that do not map. Discarded observations count as
  /// given.
  void discardWaiting();
  /// Numbers of observations that were dropped since the last call.
  std::vector<std::uint64_t> takeDropped();
  /// One sentence for each event since the last call: a sensor fell silent, was lost, is back, or its clock jumped, or
  /// the recording ended early.
  std::vector<std::string> takeNews();

  std::vector<SensorMetrics> sensors() const;
  LiveCounts counts() const;
  /// A short text for a status line: each sensor with its rate, or its state if it does not work.
  std::string sensorsText() const;
  /// Observations by label and class, as for a log.
  source::SourceReport report() const;
  /// Null if nothing is recorded.
  const Recorder* recorder() const;

 private:
  struct Parts;
  void openAll(const std::function<bool()>& stop);

  std::unique_ptr<Parts> parts_;
};

}  // namespace omnimapper::live
