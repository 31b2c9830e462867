#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/HostClock.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/Socket.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/SimulatedLog.h>
#include <sys/socket.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>
#include <thread>

#include "PlayRun.h"
#include "hokuyo/LaserConnection.h"

// Simulated Hokuyos that play a log, read by MRPT's driver through a LiveSource.
namespace omnimapper::drivers::hokuyo_test {
namespace {

using namespace live;

using mrpt::obs::CObservation2DRangeScan;

/// The first `count` scans of a robot in a room, `rate` of them a second.
players::PlayedLog logOf(std::size_t count, double rate = 40) {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  options.lasers[0].rate = rate;
  auto log = players::PlayedLog::of(testing::SimulatedLog(options).observations());
  log.lasers.at("laser").resize(count);
  log.odometry.clear();  // only the laser is played
  return log;
}

class HokuyoTest : public ::testing::Test {
 protected:
  /// The data that came from one of the lasers.
  struct Laser {
    std::vector<CObservation2DRangeScan::Ptr> received;
    std::vector<std::size_t> numbers;  // of the same scans in the log
    SensorMetrics metrics;
  };

  // Starts a laser at each address; all of them play the same scans.
  void play(players::PlayedLog log, const std::vector<std::string>& addresses,
            const std::vector<std::string>& faults = {}, players::PlayOptions play_options = {}) {
    scans = log.lasers.at("laser");
    log.lasers.clear();
    for (std::size_t i = 0; i < addresses.size(); ++i) {
      log.lasers[labelOf(i)] = scans;
      play_options.hokuyos.push_back(labelOf(i) + "=" + addresses[i]);
    }
    play_options.linger = 60;  // longer than the test, which stops it
    for (const auto& fault : faults) play_options.hokuyo.faults.push_back(players::parseFault(fault));
    lasers.resize(addresses.size());
    run = std::make_unique<players::PlayRun>(std::move(log), play_options);
    run->start();
  }

  void open(const std::string& keys = "") {
    std::string sections;
    for (std::size_t i = 0; i < lasers.size(); ++i) {
      const std::string address = run->addresses().at(i);
      const auto colon = address.find(':');
      const std::string where = colon == std::string::npos ? "COM_port_LIN = " + address
                                                           : "IP_DIR = " + address.substr(0, colon) +
                                                                 "\nPORT_DIR = " + address.substr(colon + 1);
      options.sensors.push_back(labelOf(i));
      sections += "[" + labelOf(i) + "]\ndriver = CHokuyoURG\nsensorLabel = " + labelOf(i) + "\n" + where + "\n" + keys;
    }
    const auto config = base::Config::fromText("[live]\n" + sections, "robot.ini");
    source = std::make_unique<LiveSource>(readSensors(options, config), options, nullptr);
    source->open({});
  }

  // Receives until the last scan of the log has come from each laser, or nothing for 5 s.
  void receive() {
    for (std::size_t finished = 0; finished < lasers.size();) {
      const auto next = source->next(std::chrono::seconds(5));
      for (auto& sentence : source->takeNews()) news += sentence + "\n";
      if (!next) break;
      const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(next->observation);
      auto& laser = lasers.at(scan->sensorLabel == labelOf(0) ? 0 : 1);
      laser.received.push_back(scan);
      laser.numbers.push_back(numberOf(*scan));
      if (laser.numbers.back() == scans.size() - 1) ++finished;
    }
    for (std::size_t i = 0; i < lasers.size(); ++i) lasers[i].metrics = source->sensors().at(i);
    source->close();
    run->stop();
    run->wait();
  }

  static std::string labelOf(std::size_t laser) { return laser == 0 ? "front" : "back"; }
  // The number of this scan in the log, compared to the millimetre; kNone if it is not in the log.
  std::size_t numberOf(const CObservation2DRangeScan& scan) const {
    for (std::size_t number = 0; number < scans.size(); ++number)
      if (isSame(*scans[number], scan)) return number;
    return kNone;
  }
  static bool isSame(const CObservation2DRangeScan& truth, const CObservation2DRangeScan& scan) {
    if (truth.getScanSize() != scan.getScanSize()) return false;
    for (std::size_t beam = 0; beam < truth.getScanSize(); ++beam) {
      if (truth.getScanRangeValidity(beam) != scan.getScanRangeValidity(beam)) return false;
      if (truth.getScanRangeValidity(beam) &&
          std::abs(truth.getScanRange(beam) - scan.getScanRange(beam)) > kHalfMillimetre)
        return false;
    }
    return true;
  }

  static constexpr std::size_t kNone = 9999;
  static constexpr double kHalfMillimetre = 0.000501;  // [m], and the rounding of floats

  testing::ScratchFolder folder;
  LiveOptions options;
  players::PlayedLog::Scans scans;
  std::unique_ptr<players::PlayRun> run;
  std::unique_ptr<LiveSource> source;
  std::vector<Laser> lasers;
  std::string news;
};

/// The numbers from 0 to count - 1 except those in `without`.
std::vector<std::size_t> allOf(std::size_t count, const std::set<std::size_t>& without = {}) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < count; ++i)
    if (without.count(i) == 0) all.push_back(i);
  return all;
}

TEST_F(HokuyoTest, everyScanComesToTheMillimetreWithTheTimeItWasDue) {
  play(logOf(60, 80), {"127.0.0.1:0", folder / "laser"});
  open();
  receive();
  for (std::size_t laser = 0; laser < 2; ++laser) {
    SCOPED_TRACE(run->addresses()[laser]);
    const auto& its = lasers[laser];
    ASSERT_EQ(its.numbers, allOf(60)) << news;
    const auto& played = run->hokuyo(laser).played();
    std::vector<double> late;
    for (std::size_t i = 0; i < 60; ++i)
      late.push_back(base::secondsBetween(played[i].host, its.received[i]->timestamp));
    std::sort(late.begin(), late.end());
    // On a busy machine some scans are late, and the clock of the laser has whole milliseconds.
    EXPECT_GT(late.front(), -0.002);
    EXPECT_LT(late[30], 0.1);
    EXPECT_NEAR(its.received[0]->aperture, scans[0]->aperture, 1e-4);
    EXPECT_EQ(its.metrics.left_out, 0u);
  }
}

TEST_F(HokuyoTest, damagedMessagesAreLeftOutAndCounted) {
  play(logOf(50, 80), {"127.0.0.1:0", folder / "laser"}, {"garbage@5", "half@15", "checksum@25", "slow@35:0.1"});
  open();
  receive();
  for (std::size_t laser = 0; laser < 2; ++laser) {
    EXPECT_EQ(lasers[laser].numbers, allOf(50, {15, 25})) << run->addresses()[laser] << "\n" << news;
    EXPECT_EQ(lasers[laser].metrics.left_out, 3u) << "garbage, the half and the wrong checksum; " << news;
  }
  EXPECT_NE(news.find("damaged message"), std::string::npos) << news;
  EXPECT_EQ(news.find("is lost"), std::string::npos) << news;
}

/// Expects that only scans from `first` on are lost, without other gaps, while the laser is away.
void expectGap(const std::vector<std::size_t>& numbers, std::size_t first, std::size_t count) {
  std::vector<std::size_t> expected = allOf(first);
  ASSERT_GT(numbers.size(), first);
  for (std::size_t number = numbers[first]; number < count; ++number) expected.push_back(number);
  EXPECT_EQ(numbers, expected);
  EXPECT_GT(numbers[first], first) << "the fault had no effect";
}

TEST_F(HokuyoTest, aLaserThatFellSilentIsBack) {
  options.reopen_after = 0.6;
  // A laser is reopened after three times the longest of the last ten gaps; the one before the first scan is not among
  // them any more.
  play(logOf(94), {"127.0.0.1:0"}, {"silence@12:1"});
  open();
  receive();
  expectGap(lasers[0].numbers, 12, 94);
  EXPECT_NE(news.find("is lost: "), std::string::npos) << news;
  EXPECT_NE(news.find("is back"), std::string::npos) << news;
  EXPECT_GE(lasers[0].metrics.reopened, 1u);
}

TEST_F(HokuyoTest, aLaserThatHungUpIsBack) {
  play(logOf(54), {"127.0.0.1:0", folder / "laser"}, {"hangup@4:0.3"});
  open();
  receive();
  for (std::size_t laser = 0; laser < 2; ++laser) {
    SCOPED_TRACE(run->addresses()[laser]);
    expectGap(lasers[laser].numbers, 4, 54);
    const std::string who = "sensor [" + labelOf(laser) + "] ";
    EXPECT_NE(news.find(who + "is lost: the laser closed the connection"), std::string::npos) << news;
    EXPECT_NE(news.find(who + "is back"), std::string::npos) << news;
  }
}

TEST_F(HokuyoTest, oneThatAcceptsAgainAtOnceIsBack) {
  play(logOf(44), {"127.0.0.1:0"}, {"hangup@4:0.001"});
  open();
  receive();
  expectGap(lasers[0].numbers, 4, 44);
}

TEST_F(HokuyoTest, aLaserThatAnswersSlowlyIsOpened) {
  players::PlayOptions play_options;
  play_options.hokuyo.answer_delay = 0.06;  // [s] longer than the driver listens after QT
  play(logOf(10), {"127.0.0.1:0"}, {}, play_options);
  open("comms_timeout_ms = 200\n");
  receive();
  EXPECT_EQ(lasers[0].numbers, allOf(10)) << news;
}

TEST_F(HokuyoTest, theKeysOfMrptsDriverAreHeeded) {
  auto log = logOf(40, 80);
  for (const auto& scan : log.lasers.at("laser")) {
    scan->setScanHasIntensity(true);
    for (std::size_t beam = 0; beam < scan->getScanSize(); ++beam)
      scan->setScanIntensity(beam, static_cast<int>(100 * beam));
  }
  log.lasers.at("laser").resize(39);  // so that the last one has an even number
  play(std::move(log), {"127.0.0.1:0"});
  open("intensity = true\nscan_interval = 1\npose_x = 0.25\npose_yaw = 90\n");
  receive();
  for (std::size_t i = 0; i < lasers[0].numbers.size(); ++i) EXPECT_EQ(lasers[0].numbers[i], 2 * i) << news;
  ASSERT_EQ(lasers[0].received.size(), 20u);
  ASSERT_TRUE(lasers[0].received[0]->hasIntensity());
  EXPECT_EQ(lasers[0].received[0]->getScanIntensity(7), 700);
  EXPECT_EQ(lasers[0].received[0]->sensorPose.x(), 0.25);
  EXPECT_NEAR(lasers[0].received[0]->sensorPose.yaw(), M_PI / 2, 1e-6);
}

TEST_F(HokuyoTest, aRecordedLogComesToTheMillimetre) {
  const auto path = testing::sharedData("laser2d/driving_in_office.rawlog");
  OMNIMAPPER_NEEDS(path);
  auto log = players::PlayedLog::read(*path);
  ASSERT_EQ(log.lasers.size(), 1u);
  auto laser = log.lasers.begin()->second;
  laser.resize(40);
  log.lasers = {{"laser", laser}};
  log.odometry.clear();
  players::PlayOptions play_options;
  play_options.pace = 8;
  play(std::move(log), {"127.0.0.1:0"}, {}, play_options);
  open();
  receive();
  EXPECT_EQ(lasers[0].numbers, allOf(40)) << news;
  EXPECT_NEAR(lasers[0].received[0]->aperture, scans[0]->aperture, 0.01);
}

TEST(LaserConnection, aSignalDoesNotEndTheWaiting) {
  struct sigaction action {
  }, before{};
  action.sa_handler = [](int) {};  // without SA_RESTART
  sigaction(SIGUSR1, &action, &before);
  const auto listener = listenTcp({});
  auto connection = LaserConnection::toHost("127.0.0.1", boundPort(listener));
  const Descriptor laser(accept(listener.get(), nullptr, nullptr));
  std::thread other([&, reader = pthread_self()] {
    for (int i = 0; i < 5; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      pthread_kill(reader, SIGUSR1);
    }
    send(laser.get(), "SCIP", 4, MSG_NOSIGNAL);
  });
  EXPECT_EQ(connection.receive(10'000), "SCIP");
  other.join();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(connection.receive(20), "");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(20));
  sigaction(SIGUSR1, &before, nullptr);
}

TEST(PlayRun, aPortThatWasTakenWhileTheLaserWasAwayIsReported) {
  auto log = logOf(10, 80);
  players::PlayOptions play_options;
  play_options.hokuyos = {"127.0.0.1:0"};
  play_options.hokuyo.faults = {players::parseFault("hangup@1:0.3")};
  play_options.host_start = hostNow();
  play_options.linger = 60;
  players::PlayRun run(std::move(log), play_options);
  const auto address = players::parseSocketAddress(run.addresses().at(0));
  run.start();
  Descriptor other;
  for (int i = 0; i < 5000 && !other; ++i) {
    try {
      other = listenTcp(address);
    } catch (const base::Error&) {  // the laser is still there
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  if (!other) run.stop();
  try {
    run.wait();
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("another program uses this port"), std::string::npos) << error.what();
  }
}

TEST(PlayRun, whatIsNoFaultOfOdometryIsRefused) {
  EXPECT_EQ(players::parseOdometryFault("half@5").kind, players::Fault::Kind::half);
  EXPECT_THROW(players::parseOdometryFault("checksum@5"), base::Error);
  EXPECT_THROW(players::parseOdometryFault("slow@5:0.1"), base::Error);
}

// A server that accepts a connection and sends nothing is no laser.
TEST_F(HokuyoTest, oneThatNeverAnswersIsAnError) {
  const auto silent = listenTcp({});
  const auto config =
      base::Config::fromText("[live]\nsensors = front\n[front]\ndriver = CHokuyoURG\nIP_DIR = 127.0.0.1\nPORT_DIR = " +
                                 std::to_string(boundPort(silent)) + "\n",
                             "robot.ini");
  options.sensors = {"front"};
  LiveSource source(readSensors(options, config), options, nullptr);
  try {
    source.open({});
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("does not answer"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::drivers::hokuyo_test
