#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/drivers/CheckedSensor.h>
#include <omnimapper/drivers/OdometryLine.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace omnimapper::drivers {

/// The keys of a section with `driver = COdometryLines`, in addition to those of every MRPT driver (sensorLabel, ...).
struct OdometryLinesOptions {
  enum class Protocol { tcp, udp };
  std::string bind = "127.0.0.1";
  int port = 7700;
  Protocol protocol = Protocol::tcp;
  int max_rate = 1000;           ///< [1/s]
  double max_clock_offset = 10;  ///< [s]

  static const base::OptionTable<OdometryLinesOptions>& table();
};

/// Counts of the lines, and of the clients that sent them, since initialize() was first called.
struct OdometryLineCounts {
  std::uint64_t taken = 0;          ///< lines that became observations
  std::uint64_t malformed = 0;      ///< LineFault::malformed
  std::uint64_t not_finite = 0;     ///< LineFault::not_finite
  std::uint64_t too_large = 0;      ///< LineFault::too_large
  std::uint64_t too_long = 0;       ///< lines longer than 256 bytes
  std::uint64_t too_many = 0;       ///< lines beyond max_rate_hz
  std::uint64_t wrong_clock = 0;    ///< lines whose stamp is more than max_clock_offset_s from this machine's clock
  std::uint64_t not_newer = 0;      ///< lines whose stamp is not later than that of the client's last accepted line
  std::uint64_t cut_off = 0;        ///< lines before whose end the client closed the connection or was replaced
  std::uint64_t other_sender = 0;   ///< UDP datagrams of a second sender while the first one is not silent
  std::uint64_t never_fetched = 0;  ///< observations that were discarded because 10,000 waited for getObservations()
  /// Lines without a stamp that arrived together with a later such line. They do not count as rejected.
  std::uint64_t superseded = 0;
  std::uint64_t clients = 0;  ///< clients that connected (TCP) or began to send (UDP)
  std::string first_invalid;  ///< the first line that is malformed, not finite or too large, in printable form

  /// All lines and datagrams that were rejected.
  std::uint64_t leftOut() const;
  /// The counts that are not 0, such as "2 malformed, 1 of more than 256 bytes (the first invalid line: 17.3 0.5 x)".
  std::string leftOutByReason() const;
};

/// Receives odometry from a robot's own program as lines of text over TCP or UDP. parseOdometryLine() describes the
/// format of the lines, and doc/live.md has an example. Each line becomes a CObservationOdometry with the label of the
/// sensor. An invalid line is rejected and counted; at most 256 bytes of a line are buffered.
///
/// A line without a stamp ("-") is stamped with the time of its arrival. If several such lines are read at once,
/// because the sender or this machine was held up, the times of their measurement are unknown; if they were stamped
/// some microseconds apart, the robot would seem to leap. So only the last of them becomes an observation. Odometry is
/// cumulative, so this observation contains the motion of the others.
///
/// Lines are taken from one client at a time. With TCP this is the client that connected last; the connection of the
/// client before is closed, because a robot may reconnect before its old connection is known to be lost. With UDP it is
/// the first sender, until that sender is silent for a second. A datagram holds one or more whole lines; the last line
/// feed may be missing.
///
/// This driver starts no thread. doProcess() takes what has arrived, at most some hundred KiB, and never waits.
/// counts() and port() may be called from any thread.
class COdometryLines : public mrpt::hwdrivers::CGenericSensor, public CheckedSensor {
  DEFINE_GENERIC_SENSOR(COdometryLines)
 public:
  COdometryLines();
  ~COdometryLines() override;

  /// Begins to listen. A driver that is listening stops and begins again. Throws Error(unreadable_input) if the port is
  /// in use, and Error(out_of_range) if `bind` is not an address.
  void initialize() override;
  /// Does nothing before initialize().
  void doProcess() override;

  OdometryLineCounts counts() const;
  std::uint64_t leftOut() const override { return counts().leftOut(); }
  std::string leftOutByReason() const override { return counts().leftOutByReason(); }
  bool waitsForOthers() const override { return true; }
  /// The port on which this driver listens, also if the system chose the port (`port = 0`); 0 before initialize().
  std::uint16_t port() const;

 protected:
  /// Throws Error unknown_key, wrong_type or out_of_range, naming section, key and the valid values.
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config, const std::string& section) override;

 private:
  class Receiver;
  void boundUnfetched();

  OdometryLinesOptions options_;
  mutable std::mutex mutex_;
  std::unique_ptr<Receiver> receiver_;
  OdometryLineCounts counts_;
  std::size_t unfetched_ = 0;  // upper bound of the number of observations that wait for getObservations()
};

}  // namespace omnimapper::drivers
