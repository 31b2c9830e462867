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
  std::uint32_t first_time_ms = 0;  ///< [ms] time of the device's clock at the start; it wraps at 2^24
  double clock_drift = 0;           ///< relative error of that clock; with 1e-4 it is fast by 0.1 ms a second
};

/// One scan of the log, with the times at which it was played.
struct PlayedScan {
  std::size_t index = 0;        ///< in the log, from 0
  base::Stamp log;              ///< its stamp there
  base::Stamp host;             ///< when it was due by the PlayClock, by this machine's clock
  base::Stamp sent;             ///< when its first byte was sent
  std::uint32_t device_ms = 0;  ///< its stamp by the device's clock, 24 bits
  bool was_sent = false;        ///< false if the host did not ask for it or did not read, or a fault lost it
};

/// Plays scans as a Hokuyo with SCIP 2.0 would send them.
class HokuyoPlayer {
 public:
  using Scans = std::vector<mrpt::obs::CObservation2DRangeScan::Ptr>;

  /// `scans` are of one laser, at least two, by rising stamp; `pace` scales the rate that the device reports. Throws as
  /// HokuyoModel::fitting().
  HokuyoPlayer(Scans scans, std::unique_ptr<Link> link, double pace, HokuyoPlayerOptions options = {});

  /// Answers the host until it has asked for scans for 0.2 s without a break, because MRPT's driver starts twice. False
  /// if stopped before.
  bool waitForHost(const Stop& stop);
  /// As waitForHost(), then waits until the start of all players is known.
  bool waitForStart(CommonStart& start, const Stop& stop);
  /// Sends every scan when it is due and answers the host, until the end of the log or a stop.
  void play(const PlayClock& clock, const Stop& stop);
  /// Continues to answer the host without scans for so long [s].
  void linger(double seconds, const Stop& stop);

  std::string address() const { return link_->address(); }
  const HokuyoModel& model() const { return device_.model(); }
  base::Stamp logStart() const { return scans_.front()->timestamp; }
  /// The scans that were due so far.
  const std::vector<PlayedScan>& played() const { return played_; }
  /// Writes a line of text for each scan: index, stamp in the log, host times at which it was due and sent [s since
  /// 1970], device stamp [ms], and 1 if it was sent.
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
  base::Stamp started_;  // at which the device's clock shows first_time_ms
  base::Stamp silent_until_, cut_until_;
  std::vector<PlayedScan> played_;
};

}  // namespace omnimapper::players
