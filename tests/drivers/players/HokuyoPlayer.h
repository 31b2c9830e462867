#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "CommonStart.h"
#include "Fault.h"
#include "Link.h"
#include "PlayClock.h"
#include "ScipDevice.h"

namespace omnimapper::players {

struct HokuyoPlayerOptions {
  std::vector<Fault> faults;
  double answer_delay = 0;          ///< [s] before each answer to a command
  std::uint32_t first_time_ms = 0;  ///< what the clock of the device says at the start; it wraps at 2^24
  double clock_drift = 0;           ///< by which that clock is fast, 1e-4: 0.1 ms a second
};

/// One scan of the log and what became of it.
struct PlayedScan {
  std::size_t index = 0;        ///< in the log, from 0
  base::Stamp log;              ///< its stamp there
  base::Stamp host;             ///< when it was measured on this machine's clock: due by the PlayClock
  base::Stamp sent;             ///< when its first byte was sent
  std::uint32_t device_ms = 0;  ///< the stamp that the device gave it, 24 bits
  bool was_sent = false;        ///< false where the host did not ask for it, did not read, or a fault lost it
};

/// Plays scans as a Hokuyo of SCIP 2.0 would measure them.
class HokuyoPlayer {
 public:
  using Scans = std::vector<mrpt::obs::CObservation2DRangeScan::Ptr>;

  /// `scans` by rising stamp, two at least, all of one laser; `pace` for the rate that the device names. Throws as
  /// HokuyoModel::fitting().
  HokuyoPlayer(Scans scans, std::unique_ptr<Link> link, double pace, HokuyoPlayerOptions options = {});

  /// Answers the host until it has wanted scans for 0.2 s on end: MRPT's driver starts twice. False if stopped before.
  bool waitForHost(const Stop& stop);
  /// As that, then until the start of all players is known.
  bool waitForStart(CommonStart& start, const Stop& stop);
  /// Sends every scan when it is due, and answers the host, to the end of the log or until it is stopped.
  void play(const PlayClock& clock, const Stop& stop);
  /// Answers the host on, with no more scans, for so long [s].
  void linger(double seconds, const Stop& stop);

  std::string address() const { return link_->address(); }
  const HokuyoModel& model() const { return device_.model(); }
  base::Stamp logStart() const { return scans_.front()->timestamp; }
  /// One for each scan that was due so far.
  const std::vector<PlayedScan>& played() const { return played_; }
  /// Text, a line for each scan: index, stamp in the log, host time it was due and sent at [s since 1970], device
  /// stamp [ms], 1 if it was sent.
  void writeRecord(const std::string& path) const;

 private:
  void serve(double wait);
  bool serveUntil(base::Stamp host, const Stop& stop);
  void playScan(std::size_t index, const PlayClock& clock, const Stop& stop);
  bool sendWith(const Fault* fault, const std::string& message, const Stop& stop);
  std::uint32_t deviceTime(base::Stamp host) const;

  Scans scans_;
  std::unique_ptr<Link> link_;
  HokuyoPlayerOptions options_;
  ScipDevice device_;
  base::Stamp started_;  // where the clock of the device says first_time_ms
  base::Stamp silent_until_, cut_until_;
  std::vector<PlayedScan> played_;
};

}  // namespace omnimapper::players
