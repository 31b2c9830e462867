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

/// The keys of a section with `driver = COdometryLines`, beside those of every driver of MRPT (sensorLabel, ...).
struct OdometryLinesOptions {
  enum class Protocol { tcp, udp };
  std::string bind = "127.0.0.1";
  int port = 7700;
  Protocol protocol = Protocol::tcp;
  int max_rate = 1000;           ///< [1/s]
  double max_clock_offset = 10;  ///< [s]

  static const base::OptionTable<OdometryLinesOptions>& table();
};

/// What became of the lines since initialize() was first called, and of those who sent them.
struct OdometryLineCounts {
  std::uint64_t taken = 0;          ///< became observations
  std::uint64_t malformed = 0;      ///< LineFault::malformed
  std::uint64_t not_finite = 0;     ///< LineFault::not_finite
  std::uint64_t too_large = 0;      ///< LineFault::too_large
  std::uint64_t too_long = 0;       ///< longer than 256 bytes
  std::uint64_t too_many = 0;       ///< beyond max_rate_hz
  std::uint64_t wrong_clock = 0;    ///< stamps further than max_clock_offset_s from this machine's clock
  std::uint64_t not_newer = 0;      ///< stamps not later than those before them of the same client
  std::uint64_t cut_off = 0;        ///< the client hung up, or was replaced, before their end
  std::uint64_t other_sender = 0;   ///< UDP datagrams of a second sender beside one who is not silent
  std::uint64_t never_fetched = 0;  ///< taken, and discarded when 10,000 waited for getObservations()
  std::uint64_t superseded =
      0;                      ///< lines without stamps that arrived together with a later one, which are not rejected
  std::uint64_t clients = 0;  ///< who connected (TCP) or began to send (UDP)
  std::string first_invalid;  ///< the first line that is malformed, not finite or too large, printable

  /// All lines and datagrams that were rejected.
  std::uint64_t leftOut() const;
  /// Those of each kind that is not 0: "2 malformed, 1 of more than 256 bytes (the first invalid line: 17.3 0.5 x)".
  std::string leftOutByReason() const;
};

/// Odometry of a robot's own program, as lines of text over TCP or UDP: parseOdometryLine() has their form,
/// doc/live.md an example. Each becomes a CObservationOdometry with the label of the sensor. An invalid line is
/// rejected and counted; at most 256 bytes of a line are buffered.
///
/// A line without a stamp ("-") gets that of its arrival. Of several that are read at one time, because the sender or
/// this machine was held up, it is unknown when each was measured, and stamps some microseconds apart would make leaps
/// of them. So the last one alone becomes an observation: odometry is cumulative, and the others are contained in it.
///
/// One client counts at a time. TCP: whoever connects last; the connection before is closed, for a robot may connect
/// anew before its lost connection is known to be lost. UDP: the first sender, until it is silent for a second. A
/// datagram holds one or more whole lines; the end of the last one may be missing.
///
/// It has no thread of its own: doProcess() takes what has arrived, at most 256 KiB, and never waits. counts() and
/// port() may be called from any thread.
class COdometryLines : public mrpt::hwdrivers::CGenericSensor, public CheckedSensor {
  DEFINE_GENERIC_SENSOR(COdometryLines)
 public:
  COdometryLines();
  ~COdometryLines() override;

  /// Listens from now on, anew if it did before. Throws Error(unreadable_input) if the port is in use, and
  /// Error(out_of_range) if `bind` is no address.
  void initialize() override;
  /// Does nothing before initialize().
  void doProcess() override;

  OdometryLineCounts counts() const;
  std::uint64_t leftOut() const override { return counts().leftOut(); }
  std::string leftOutByReason() const override { return counts().leftOutByReason(); }
  bool waitsForOthers() const override { return true; }
  /// Where it listens, 0 before initialize(); tells which port the system chose for `port = 0`.
  std::uint16_t port() const;

 protected:
  /// Throws Error unknown_key, wrong_type or out_of_range, naming section, key and what fits.
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config, const std::string& section) override;

 private:
  class Receiver;
  void boundUnfetched();

  OdometryLinesOptions options_;
  mutable std::mutex mutex_;
  std::unique_ptr<Receiver> receiver_;
  OdometryLineCounts counts_;
  std::size_t unfetched_ = 0;  // upper bound of what waits for getObservations()
};

}  // namespace omnimapper::drivers
