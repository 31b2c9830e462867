#include <mrpt/io/CStream.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/drivers/CCheckedHokuyo.h>
#include <omnimapper/live/HostClock.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "hokuyo/LaserClock.h"
#include "hokuyo/LaserConnection.h"
#include "hokuyo/ScipCheck.h"

IMPLEMENTS_GENERIC_SENSOR(CCheckedHokuyo, omnimapper::drivers)

namespace omnimapper::drivers {

/// The stream that MRPT's driver reads: valid answers to the command that it wrote last.
class CCheckedHokuyo::Stream : public mrpt::io::CStream {
 public:
  Stream(LaserConnection connection, int patience) : connection_(std::move(connection)), patience_(patience) {}

  std::size_t Read(void* buffer, std::size_t count) override {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience_);
    while (valid_.empty() && connection_.isOpen()) {
      const auto left = end - std::chrono::steady_clock::now();
      if (left.count() <= 0) break;
      check_.add(connection_.receive(
          static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(left).count()) + 1));
      valid_ = check_.take();
    }
    const auto size = valid_.copy(static_cast<char*>(buffer), count);
    valid_.erase(0, size);
    return size;
  }
  std::size_t Write(const void* buffer, std::size_t count) override {
    const std::string_view command(static_cast<const char*>(buffer), count);
    check_.setCommand(command);
    valid_.clear();
    return connection_.send(command) ? count : 0;
  }
  std::uint64_t Seek(std::int64_t, mrpt::io::CStream::TSeekOrigin) override { return 0; }
  std::uint64_t getTotalBytesCount() const override { return 0; }
  std::uint64_t getPosition() const override { return 0; }

  // Sends a command and discards the data that comes in the next tenths of a second.
  void sendAndForget(std::string_view command) {
    connection_.send(command);
    for (int i = 0; i < 20 && !connection_.receive(20).empty(); ++i) {
    }
  }

  LaserConnection& connection() { return connection_; }
  std::uint64_t damaged() const { return check_.damaged(); }

 private:
  LaserConnection connection_;
  const int patience_;
  ScipCheck check_;
  std::string valid_;
};

CCheckedHokuyo::CCheckedHokuyo() = default;

CCheckedHokuyo::~CCheckedHokuyo() {
  // MRPT's destructor would write to the closed connection once more, and print an error.
  if (stream_ && !stream_->connection().isOpen()) bindIO(nullptr);
}

void CCheckedHokuyo::initialize() {
  m_state = ssError;
  logging_enable_console_output = false;  // errors are thrown instead
  damaged_before_ = leftOut();
  const int patience = std::max(m_comms_timeout_ms, 100);
  stream_ = std::make_shared<Stream>(m_ip_dir.empty()
                                         ? LaserConnection::toSerialPort(m_com_port)
                                         : LaserConnection::toHost(m_ip_dir, static_cast<std::uint16_t>(m_port_dir)),
                                     patience);
  bindIO(stream_);
  stopMeasuring();
  clock_ = std::make_unique<LaserClock>();
  bool answers = false;
  try {
    answers = turnOn();
  } catch (const std::exception&) {
    // If the connection is closed, MRPT's message names only its source code; the one below says more.
    if (stream_->connection().isOpen()) throw;
  }
  if (!answers)
    throw std::runtime_error(
        "the device does not answer in SCIP 2.0: is it a Hokuyo, and is its address or port right?");
  requirePossibleProperties();
  m_state = ssWorking;
}

// A laser may still be measuring for a program that has ended, and a serial one may use either of two rates.
void CCheckedHokuyo::stopMeasuring() {
  auto& connection = stream_->connection();
  if (connection.isSerial()) {
    for (const int rate : {115200, 19200}) {
      connection.setBaudRate(rate);
      stream_->sendAndForget("QT\n");
    }
    stream_->sendAndForget("SS115200\n");
    connection.setBaudRate(115200);
  }
  stream_->sendAndForget("QT\n");
}

void CCheckedHokuyo::requirePossibleProperties() const {
  const auto& its = m_sensor_info;
  constexpr int kMostSteps = 10'000;  // steps have four digits
  if (its.scans_per_360deg < 1 || its.scans_per_360deg > 10 * kMostSteps || its.scan_first < 0 ||
      its.scan_last <= its.scan_first || its.scan_last >= kMostSteps || !(its.d_max > 0))
    throw std::runtime_error("the laser reports impossible properties (PP)");
}

void CCheckedHokuyo::doProcessSimple(bool& is_there, mrpt::obs::CObservation2DRangeScan& scan, bool& has_failed) {
  if (!stream_ || !m_stream || !stream_->connection().isOpen())
    throw std::runtime_error("the laser closed the connection");
  CHokuyoURG::doProcessSimple(is_there, scan, has_failed);
  if (!is_there) {
    if (!m_stream) throw std::runtime_error("the laser has stopped measuring");
    return;
  }
  const auto beams = static_cast<float>(scan.getScanSize());
  scan.aperture *= (beams - 1) / beams;
  const auto arrival = live::hostNow();
  std::uint32_t device_ms = 0;
  for (std::size_t i = 0; i < 4; ++i) device_ms = device_ms << 6 | ((m_rcv_data.at(i) - 0x30) & 0x3f);
  scan.timestamp = m_disable_firmware_timestamp ? arrival : clock_->stampOf(device_ms, arrival);
}

std::uint64_t CCheckedHokuyo::leftOut() const {
  return damaged_before_ + (stream_ ? stream_->damaged() : 0);
}

std::string CCheckedHokuyo::leftOutByReason() const {
  return base::counted(leftOut(), "damaged message");
}

}  // namespace omnimapper::drivers
