#include <omnimapper/drivers/COdometryLines.h>
#include <omnimapper/drivers/readDriverSection.h>

#include <utility>

#include "odometry/OdometryReceiver.h"

IMPLEMENTS_GENERIC_SENSOR(COdometryLines, omnimapper::drivers)

namespace omnimapper::drivers {

namespace {

constexpr std::size_t kMostUnfetched = 10'000;

}  // namespace

const base::OptionTable<OdometryLinesOptions>& OdometryLinesOptions::table() {
  using Options = OdometryLinesOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("bind", &Options::bind,
                "Address of this machine on which lines are accepted: 127.0.0.1 from this machine alone, 0.0.0.0 "
                "from everyone who can reach it.")
          .integer("port", &Options::port, {0, 65535}, "Port on which lines are accepted; 0 lets the system choose.")
          .choice("protocol", &Options::protocol, {{"tcp", Protocol::tcp}, {"udp", Protocol::udp}},
                  "Whether lines come over a TCP connection or in UDP datagrams.")
          .integer("max_rate_hz", &Options::max_rate, {1, 100'000},
                   "Largest number of lines accepted in a second; lines beyond it are rejected.")
          .number("max_clock_offset_s", &Options::max_clock_offset, base::Range::positive(),
                  "A line is rejected if its time stamp differs from this machine's clock by more than this.");
  return table;
}

std::uint64_t OdometryLineCounts::leftOut() const {
  return malformed + not_finite + too_large + too_long + too_many + wrong_clock + not_newer + cut_off + other_sender +
         never_fetched;
}

std::string OdometryLineCounts::leftOutByReason() const {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(malformed, "malformed");
  add(not_finite, "with a value that is no finite number");
  add(too_large, "with a value beyond all bounds");
  add(too_long, "of more than 256 bytes");
  add(too_many, "beyond max_rate_hz");
  add(wrong_clock, "whose stamp is further than max_clock_offset_s from the clock of this machine");
  add(not_newer, "not later than the line before");
  add(cut_off, "cut off when a client hung up");
  add(other_sender, "from a second sender of datagrams");
  add(never_fetched, "that nobody fetched");
  if (!first_invalid.empty()) text += " (the first invalid line: " + first_invalid + ")";
  return text;
}

COdometryLines::COdometryLines() {
  m_sensorLabel = "odometry";
}

COdometryLines::~COdometryLines() = default;

void COdometryLines::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                               const std::string& section) {
  options_ = readUnderMrpt([&] { return readDriverSection<OdometryLinesOptions>(config, section); });
}

void COdometryLines::initialize() {
  const std::lock_guard lock(mutex_);
  receiver_.reset();  // frees its port
  m_state = ssError;
  receiver_ = std::make_unique<Receiver>(options_);
  m_state = ssWorking;
}

void COdometryLines::doProcess() {
  const std::lock_guard lock(mutex_);
  if (!receiver_) return;
  receiver_->receive(counts_, [&](const mrpt::obs::CObservationOdometry::Ptr& odometry) {
    if (unfetched_ >= kMostUnfetched) boundUnfetched();
    odometry->sensorLabel = m_sensorLabel;
    appendObservation(odometry);
    ++unfetched_;
  });
}

// Bounds the list of MRPT's base class, which grows without limit if nobody fetches the observations.
void COdometryLines::boundUnfetched() {
  const auto waiting = getObservations();
  unfetched_ = 0;
  if (waiting.size() >= kMostUnfetched / 2) {
    counts_.never_fetched += waiting.size();
    return;
  }
  const auto decimation = std::exchange(m_grab_decimation, 1);  // these observations have passed it
  for (const auto& [stamp, observation] : waiting) appendObservation(observation);
  m_grab_decimation = decimation;
  unfetched_ = waiting.size();
}

OdometryLineCounts COdometryLines::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::uint16_t COdometryLines::port() const {
  const std::lock_guard lock(mutex_);
  return receiver_ ? receiver_->port() : 0;
}

}  // namespace omnimapper::drivers
