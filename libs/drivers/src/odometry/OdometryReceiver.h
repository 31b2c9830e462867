#pragma once

#include <omnimapper/drivers/COdometryLines.h>
#include <omnimapper/live/Socket.h>

#include <chrono>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "odometry/LineBuffer.h"

namespace omnimapper::drivers {

/// The connections of COdometryLines: splits the bytes into lines and passes on valid lines.
class COdometryLines::Receiver {
 public:
  using Take = std::function<void(mrpt::obs::CObservationOdometry::Ptr)>;

  /// Listens; throws as COdometryLines::initialize().
  explicit Receiver(const OdometryLinesOptions& options);

  std::uint16_t port() const { return boundPort(socket_); }
  /// Reads what has arrived and calls take(odometry), with its stamp, for each valid line; of lines without stamps that
  /// arrived together, only for the last one.
  void receive(OdometryLineCounts& counts, const Take& take);

 private:
  using Monotonic = std::chrono::steady_clock;

  void acceptClients(OdometryLineCounts& counts);
  void readClient(OdometryLineCounts& counts, const Take& take);
  void readDatagrams(OdometryLineCounts& counts, const Take& take);
  bool isOfCurrentSender(std::uint64_t sender, OdometryLineCounts& counts);
  void beginClient(OdometryLineCounts& counts);
  void takeLine(std::string_view line, OdometryLineCounts& counts, const Take& take);
  void takeOdometry(const OdometryLine& line, base::Stamp stamp, OdometryLineCounts& counts, const Take& take);
  void takeUnstamped(OdometryLineCounts& counts, const Take& take);
  bool isWithinRate();
  LineBuffer& addTo(LineBuffer& buffer, std::string_view bytes, OdometryLineCounts& counts, const Take& take);

  OdometryLinesOptions options_;
  live::Descriptor socket_, client_;
  LineBuffer line_;
  std::vector<char> bytes_;
  base::Stamp newest_;  // of this client
  // The last line without a stamp of those that are being read, and its arrival.
  std::optional<std::pair<OdometryLine, base::Stamp>> unstamped_;
  std::uint64_t sender_ = 0;     // UDP: address and port; 0: none yet
  Monotonic::time_point heard_;  // UDP: the last datagram of that sender
  double allowance_;             // lines that may still come at once
  Monotonic::time_point allowed_;
};

}  // namespace omnimapper::drivers
