#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/Socket.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "PlayedLog.h"

// Tests of omnimapper-play: a log's laser and odometry come through their drivers as they are in the log.
namespace omnimapper::live::play_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;

constexpr double kPace = 8;

std::uint16_t freePort() {
  return boundPort(listenTcp({}));
}

/// The first `seconds` of a robot's drive in a rawlog, with the true trajectory of the whole drive beside it.
players::PlayedLog writeLog(const std::string& rawlog, const std::string& truth, double seconds) {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  const testing::SimulatedLog log(options);
  log.writeTruthTum(truth);
  log.writeRawlog(rawlog);
  auto observations = log.observations();
  observations.erase(
      std::remove_if(observations.begin(), observations.end(),
                     [&](const auto& each) { return base::secondsBetween(log.begin(), each->timestamp) > seconds; }),
      observations.end());
  return players::PlayedLog::of(observations);
}

class PlayTest : public ::testing::Test {
 protected:
  // Plays the log to a LiveSource of both sensors until all of it has come.
  void play(const players::PlayedLog& log, const std::string& protocol) {
    const auto laser_port = freePort(), odometry_port = freePort();
    std::vector<std::string> command{testing::ownProgram("omnimapper-play"),
                                     folder / "log.rawlog",
                                     "--hokuyo",
                                     "127.0.0.1:" + std::to_string(laser_port),
                                     "--odometry",
                                     "127.0.0.1:" + std::to_string(odometry_port),
                                     "--pace",
                                     std::to_string(kPace),
                                     "--truth",
                                     folder / "truth.tum",
                                     "--shifted-truth",
                                     folder / "host.tum"};
    if (protocol == "udp") command.push_back("--udp");
    testing::Program program(command);
    const auto config = base::Config::fromText(
        "[live]\nsensors = front, wheels\n[front]\ndriver = CHokuyoURG\nsensorLabel = front\nIP_DIR = 127.0.0.1\n"
        "PORT_DIR = " +
            std::to_string(laser_port) +
            "\n[wheels]\ndriver = COdometryLines\nsensorLabel = wheels\n"
            "port = " +
            std::to_string(odometry_port) + "\nprotocol = " + protocol + "\n",
        "robot.ini");
    LiveOptions options;
    options.sensors = {"front", "wheels"};
    std::unique_ptr<LiveSource> source;
    for (int i = 0; i < 100 && !source; ++i) {  // the log is read first
      source = std::make_unique<LiveSource>(readSensors(options, config), options, nullptr);
      try {
        source->open({});
      } catch (const std::exception&) {
        source.reset();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
    ASSERT_TRUE(source);
    while (scans.size() < log.lasers.at("laser").size() || odometry.size() < log.odometry.size()) {
      const auto next = source->next(std::chrono::seconds(5));
      if (!next) break;
      if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(next->observation)) scans.push_back(scan);
      if (auto wheels = std::dynamic_pointer_cast<CObservationOdometry>(next->observation)) odometry.push_back(wheels);
    }
    left_out = source->sensors().at(0).left_out + source->sensors().at(1).left_out;
    source->close();
    program.send(SIGINT);
    const auto ended = program.wait();
    EXPECT_TRUE(ended.code == 130 || ended.code == 0) << testing::toString(ended);  // 0: the log was played to its end
    std::istringstream words(ended.out);
    for (std::string word; words >> word;)
      if (word == "host_start" && words >> word) host_start = base::parseUnix(word);
  }

  // The time in the log that corresponds to a stamp of the host.
  base::Stamp inLog(const players::PlayedLog& log, base::Stamp host) const {
    return log.start() + base::durationFromSeconds(base::secondsBetween(host_start, host) * kPace);
  }

  testing::ScratchFolder folder;
  std::vector<CObservation2DRangeScan::Ptr> scans;
  std::vector<CObservationOdometry::Ptr> odometry;
  std::uint64_t left_out = 0;
  base::Stamp host_start;
};

TEST_F(PlayTest, laserAndOdometryComeAsInTheLogByOneClock) {
  const auto log = writeLog(folder / "log.rawlog", folder / "truth.tum", 8);
  play(log, "tcp");
  ASSERT_TRUE(base::isValid(host_start));
  EXPECT_EQ(left_out, 0u);
  ASSERT_GE(odometry.size(), log.odometry.size());
  for (std::size_t i = 0; i < log.odometry.size(); ++i) {
    EXPECT_EQ(odometry[i]->odometry.x(), log.odometry[i].odom_from_base.x()) << i;
    EXPECT_EQ(odometry[i]->odometry.phi(), log.odometry[i].odom_from_base.phi()) << i;
    EXPECT_NEAR(base::secondsBetween(log.odometry[i].log, inLog(log, odometry[i]->timestamp)), 0, 1e-5) << i;
  }
  const auto& played = log.lasers.at("laser");
  ASSERT_GE(scans.size(), played.size());
  std::vector<double> late;
  for (std::size_t i = 0; i < played.size(); ++i) {
    ASSERT_EQ(scans[i]->getScanSize(), played[i]->getScanSize());
    for (std::size_t beam = 0; beam < played[i]->getScanSize(); ++beam) {
      if (!played[i]->getScanRangeValidity(beam)) continue;
      EXPECT_NEAR(scans[i]->getScanRange(beam), played[i]->getScanRange(beam), 0.000501) << i << " " << beam;
    }
    late.push_back(base::secondsBetween(played[i]->timestamp, inLog(log, scans[i]->timestamp)) / kPace);
  }
  std::sort(late.begin(), late.end());
  EXPECT_NEAR(late[late.size() / 2], 0, 0.1);
  // The truth has the host's stamps.
  const auto truth = eval::readTum(folder / "truth.tum"), shifted = eval::readTum(folder / "host.tum");
  ASSERT_EQ(truth.size(), shifted.size());
  EXPECT_NEAR(base::secondsBetween(truth[100].stamp, inLog(log, shifted[100].stamp)), 0, 1e-5);
}

TEST_F(PlayTest, odometryComesByDatagramsToo) {
  const auto log = writeLog(folder / "log.rawlog", folder / "truth.tum", 3);
  play(log, "udp");
  ASSERT_GE(odometry.size(), log.odometry.size());
  for (std::size_t i = 0; i < log.odometry.size(); ++i)
    EXPECT_EQ(odometry[i]->odometry.x(), log.odometry[i].odom_from_base.x()) << i;
}

TEST(PlayedLog, motionsAreAddedUpWhereThereIsNoOdometry) {
  testing::SimulatedLogOptions options;
  options.place = testing::SimulatedLogOptions::Place::box;
  const testing::SimulatedLog log(options);
  const testing::ScratchFolder folder;
  log.writeRawlog(folder / "log.rawlog", testing::SimulatedLog::Format::actions_and_frames);
  const auto played = players::PlayedLog::read(folder / "log.rawlog");
  const auto whole = players::PlayedLog::of(log.observations());
  ASSERT_GT(played.odometry.size(), 100u);
  const auto& last = played.odometry.back();
  const auto same = std::min_element(whole.odometry.begin(), whole.odometry.end(), [&](const auto& a, const auto& b) {
    return std::abs(base::secondsBetween(a.log, last.log)) < std::abs(base::secondsBetween(b.log, last.log));
  });
  EXPECT_NEAR(last.odom_from_base.x(), same->odom_from_base.x(), 0.1);
  EXPECT_NEAR(last.odom_from_base.y(), same->odom_from_base.y(), 0.1);
}

}  // namespace
}  // namespace omnimapper::live::play_test
