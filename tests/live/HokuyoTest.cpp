#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <thread>

#include "PlayRun.h"

// MRPT's own driver of Hokuyos, told by a played one.
namespace omnimapper::live::hokuyo_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using std::chrono::milliseconds;

/// Scans of a robot in a room, the first `count` of them, so many a second.
players::PlayedLog logOf(std::size_t count, double rate = 20) {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  options.lasers[0].rate = rate;
  auto log = players::PlayedLog::of(testing::SimulatedLog(options).observations());
  log.lasers.at("laser").resize(count);
  log.odometry.clear();
  return log;
}

class HokuyoTest : public ::testing::Test {
 protected:
  void play(players::PlayedLog log, const std::string& address = "127.0.0.1:0", players::PlayOptions options = {}) {
    scans = log.lasers.at("laser");
    options.hokuyos = {address};
    run = std::make_unique<players::PlayRun>(std::move(log), options);
    run->start();
  }

  // A source with MRPT's driver of the played laser, opened.
  void open(const std::string& more = "") {
    const std::string address = run->addresses().at(0);
    const auto colon = address.find(':');
    const std::string where = colon == std::string::npos ? "COM_port_LIN = " + address
                                                         : "IP_DIR = " + address.substr(0, colon) +
                                                               "\nPORT_DIR = " + address.substr(colon + 1);
    const auto config = base::Config::fromText(
        "[live]\nsensors = front\n[front]\ndriver = CHokuyoURG\nsensorLabel = laser\n" + where + "\n" + more,
        "robot.ini");
    options.sensors = {"front"};
    source = std::make_unique<LiveSource>(readSensors(options, config), options, nullptr);
    source->open({});
  }

  // All scans that come until the play is over and nothing has come for a while.
  void receive(milliseconds patience = milliseconds(300)) {
    std::thread waits([this] {
      run->wait();
      over = true;
    });
    for (;;) {
      const bool was_over = over;
      const auto next = source->next(patience);
      for (auto& sentence : source->takeNews()) news += sentence + "\n";
      if (!next && was_over) break;
      if (next) received.push_back(std::dynamic_pointer_cast<CObservation2DRangeScan>(next->observation));
    }
    waits.join();
    source->close();
  }

  // The scan of the log that this one is, to the millimetre; none: a scan that never was.
  std::optional<std::size_t> numberOf(const CObservation2DRangeScan& scan) const {
    for (std::size_t number = 0; number < scans.size(); ++number)
      if (isSame(*scans[number], scan)) return number;
    return std::nullopt;
  }
  static bool isSame(const CObservation2DRangeScan& truth, const CObservation2DRangeScan& scan) {
    if (truth.getScanSize() != scan.getScanSize()) return false;
    for (std::size_t beam = 0; beam < truth.getScanSize(); ++beam) {
      if (truth.getScanRangeValidity(beam) != scan.getScanRangeValidity(beam)) return false;
      if (truth.getScanRangeValidity(beam) && std::abs(truth.getScanRange(beam) - scan.getScanRange(beam)) > 0.000501)
        return false;
    }
    return true;
  }
  // The numbers of all that was received; 9999 for a scan that never was.
  std::vector<std::size_t> numbers() const {
    std::vector<std::size_t> all;
    for (const auto& scan : received) all.push_back(numberOf(*scan).value_or(9999));
    return all;
  }

  testing::ScratchFolder folder;
  LiveOptions options;
  players::PlayedLog::Scans scans;
  std::unique_ptr<players::PlayRun> run;
  std::unique_ptr<LiveSource> source;
  std::vector<CObservation2DRangeScan::Ptr> received;
  std::string news;
  std::atomic<bool> over{false};
};

std::vector<std::size_t> upTo(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

TEST_F(HokuyoTest, overTcpEveryScanComesToTheMillimetre) {
  play(logOf(40));
  open();
  receive();
  EXPECT_EQ(numbers(), upTo(40)) << news;
}

TEST_F(HokuyoTest, overATerminalEveryScanComesToTheMillimetre) {
  play(logOf(40), folder / "laser");
  open("comms_timeout_ms = 10\n");
  receive();
  EXPECT_EQ(numbers(), upTo(40)) << news;
}

class FaultyHokuyoTest : public HokuyoTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(FaultyHokuyoTest, noScanThatNeverWasIsBelieved) {
  players::PlayOptions play_options;
  play_options.hokuyo.faults.push_back(players::parseFault(GetParam()));
  options.silent_after = 0.3;
  options.reopen_after = 0.6;
  play(logOf(60), "127.0.0.1:0", play_options);
  open();
  receive(milliseconds(1000));
  std::string got;
  for (auto n : numbers()) got += std::to_string(n) + " ";
  std::cerr << GetParam() << ": " << got << "\n" << news;
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyHokuyoTest,
                         ::testing::Values("garbage@10", "half@10", "checksum@10", "slow@10:0.4", "silence@10:1.2",
                                           "hangup@10:1"));

}  // namespace
}  // namespace omnimapper::live::hokuyo_test
