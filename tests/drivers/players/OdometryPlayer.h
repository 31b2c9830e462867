#pragma once

#include <omnimapper/live/Socket.h>

#include <cstdint>
#include <string>
#include <vector>

#include "CommonStart.h"
#include "Fault.h"
#include "PlayedLog.h"

namespace omnimapper::players {

struct OdometryPlayerOptions {
  live::SocketAddress to{"127.0.0.1", 7700};
  bool udp = false;
  std::vector<Fault> faults;  ///< without checksum and slow, which are only for lasers
};

/// Sends odometry as the lines that drivers::COdometryLines takes, as a robot's own program would do.
class OdometryPlayer {
 public:
  OdometryPlayer(std::vector<OdometryReading> readings, OdometryPlayerOptions options);

  /// Tries to connect five times a second until somebody listens. With UDP it returns at once. False if stopped before.
  bool connect(const Stop& stop);
  /// Waits for its host and for the other players, then sends each line when it is due, with that time as its stamp,
  /// until the end of the log or a stop. Connects again if the connection is lost.
  void play(CommonStart& start, const Stop& stop);

  /// Number of lines that were passed to the system.
  std::uint64_t sent() const { return sent_; }

 private:
  bool tryToConnect();
  const Fault* faultAt(std::size_t number) const;
  bool send(const std::string& line);

  std::vector<OdometryReading> readings_;
  OdometryPlayerOptions options_;
  live::Descriptor socket_;
  std::uint64_t sent_ = 0;
};

/// One line, with its line feed, stamped with `host`; the velocity is `pace` times that of the log.
std::string odometryLine(const OdometryReading& reading, base::Stamp host, double pace);

}  // namespace omnimapper::players
