#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <limits>

namespace omnimapper::mapper::engine_input_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using testing::bitsOf;
using testing::kLaserIni;
using testing::makeEngine;
using testing::SimulatedLog;
using testing::SimulatedLogOptions;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

SimulatedLogOptions halfALap() {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  options.laps = 0.5;
  return options;
}

template <class Class>
std::shared_ptr<Class> copyOf(const CObservation& observation) {
  return std::dynamic_pointer_cast<Class>(observation.duplicateGetSmartPtr());
}

// The first observation of a class at or after an index.
template <class Class>
std::size_t indexOf(const std::vector<CObservation::Ptr>& log, std::size_t from) {
  while (!dynamic_cast<const Class*>(log.at(from).get())) ++from;
  return from;
}

// A clean log and one with something bad inserted in its middle; both are mapped.
class EngineInput : public ::testing::Test {
 protected:
  std::vector<CObservation::Ptr> log_ = SimulatedLog(halfALap()).observations();
  std::size_t odometry_ = indexOf<CObservationOdometry>(log_, log_.size() / 2);
  std::size_t scan_ = indexOf<CObservation2DRangeScan>(log_, log_.size() / 2);

  /// Expects the same map, to the bit, as without the inserted observation; returns the counts.
  RunCounts countsWith(const CObservation::Ptr& bad, std::size_t place, const std::vector<std::string>& settings = {}) {
    auto spoiled = log_;
    spoiled.insert(spoiled.begin() + static_cast<std::ptrdiff_t>(place), bad);
    const auto clean = makeEngine(kLaserIni, settings), engine = makeEngine(kLaserIni, settings);
    testing::run(*clean, log_);
    testing::run(*engine, spoiled);
    EXPECT_EQ(bitsOf(engine->view()), bitsOf(clean->view()));
    EXPECT_EQ(engine->view().counts.observations, log_.size() + 1);
    return engine->view().counts;
  }
};

TEST_F(EngineInput, AZeroStampIsRefusedAndCounted) {
  for (const std::size_t index : {odometry_, scan_}) {
    const auto bad = copyOf<CObservation>(*log_[index]);
    bad->timestamp = mrpt::Clock::time_point();
    EXPECT_EQ(countsWith(bad, index + 1).no_stamp, 1U);
  }
}

TEST_F(EngineInput, ARepeatedStampIsRefusedAndCounted) {
  for (const std::size_t index : {odometry_, scan_}) {
    EXPECT_EQ(countsWith(copyOf<CObservation>(*log_[index]), index + 1).repeated_stamp, 1U);
  }
}

TEST_F(EngineInput, ARepeatedScanIsRefusedAndCountedThoughOthersCameBetween) {
  const std::size_t later = indexOf<CObservation2DRangeScan>(log_, scan_ + 1) + 1;
  EXPECT_EQ(countsWith(copyOf<CObservation>(*log_[scan_]), later).repeated_stamp, 1U);
}

TEST_F(EngineInput, WhatComesLaterThanTheHorizonIsRefusedAndCounted) {
  const auto late = copyOf<CObservation2DRangeScan>(*log_[scan_]);
  late->timestamp -= base::durationFromSeconds(4);
  late->sensorLabel = "slow laser";
  EXPECT_EQ(countsWith(late, scan_ + 1, {"mapper.horizon_s=0"}).too_late, 1U);
}

TEST_F(EngineInput, OdometryThatIsNotFiniteIsRefusedAndCounted) {
  for (const auto& pose : {mrpt::poses::CPose2D(kNan, 0, 0), mrpt::poses::CPose2D(0, kInf, 0)}) {
    const auto bad = copyOf<CObservationOdometry>(*log_[odometry_]);
    bad->odometry = pose;
    bad->timestamp += base::durationFromSeconds(0.001);
    EXPECT_EQ(countsWith(bad, odometry_ + 1).unusable, 1U);
  }
}

TEST_F(EngineInput, OdometryThatRunsBackwardsIsRefusedAndCounted) {
  const auto bad = copyOf<CObservationOdometry>(*log_[odometry_]);
  bad->timestamp -= base::durationFromSeconds(0.3);
  EXPECT_EQ(countsWith(bad, odometry_ + 1).unusable, 1U);
}

TEST_F(EngineInput, WhatNobodyWantsIsCounted) {
  const auto comment = mrpt::obs::CObservationComment::Create();
  comment->timestamp = log_[scan_]->timestamp;
  EXPECT_EQ(countsWith(comment, scan_ + 1).unwanted, 1U);
}

// A clock jump of one sensor must not cost the rest of the log.
TEST_F(EngineInput, AStampInAFarFutureSpoilsNothingAfterIt) {
  const auto bad = copyOf<CObservation2DRangeScan>(*log_[scan_]);
  bad->sensorLabel = "clock gone mad";
  bad->timestamp += base::durationFromSeconds(1e8);
  auto spoiled = log_;
  spoiled.insert(spoiled.begin() + static_cast<std::ptrdiff_t>(scan_), bad);
  const auto clean = makeEngine(kLaserIni), engine = makeEngine(kLaserIni);
  testing::run(*clean, log_);
  testing::run(*engine, spoiled);
  const auto& frames = engine->view().map.key_frames;
  const auto& clean_frames = clean->view().map.key_frames;
  ASSERT_GE(frames.size(), clean_frames.size());
  for (std::size_t i = 0; i < clean_frames.size(); ++i) {
    EXPECT_EQ(frames[i].stamp, clean_frames[i].stamp);
    EXPECT_LT((frames[i].map_from_base - clean_frames[i].map_from_base).translation().norm(), 0.02);
  }
}

TEST_F(EngineInput, ScansWithoutAValidBeamAreKeyFramesWithoutMatches) {
  for (const bool without_beams : {true, false}) {
    auto log = SimulatedLog(halfALap()).observations();
    for (const auto& observation : log) {
      if (auto* scan = dynamic_cast<CObservation2DRangeScan*>(observation.get())) {
        if (without_beams) scan->resizeScan(0);
        for (std::size_t i = 0; i < scan->getScanSize(); ++i) scan->setScanRangeValidity(i, false);
      }
    }
    const auto engine = makeEngine(kLaserIni);
    testing::run(*engine, log);
    const auto view = engine->view();
    EXPECT_GT(view.map.key_frames.size(), 10U);
    for (const auto& [id, record] : view.graph.factors()) EXPECT_EQ(record.tags.owner, "odometry");
    EXPECT_TRUE(std::none_of(view.decisions.begin(), view.decisions.end(), [](const auto& d) { return d.accepted; }));
  }
}

TEST_F(EngineInput, RangesThatAreNotFiniteCountAsInvalid) {
  auto marked = SimulatedLog(halfALap()).observations(), spoiled = SimulatedLog(halfALap()).observations();
  for (std::size_t k = 0; k < marked.size(); ++k) {
    auto* scan = dynamic_cast<CObservation2DRangeScan*>(marked[k].get());
    if (!scan) continue;
    auto* bad = dynamic_cast<CObservation2DRangeScan*>(spoiled[k].get());
    for (std::size_t i = 0; i < scan->getScanSize(); i += 7) {
      scan->setScanRangeValidity(i, false);
      bad->setScanRange(i, static_cast<float>(i % 2 ? kNan : kInf));
    }
  }
  const auto expected = makeEngine(kLaserIni), engine = makeEngine(kLaserIni);
  testing::run(*expected, marked);
  testing::run(*engine, spoiled);
  std::ostringstream expected_graph, graph;
  graph::writeGraph(expected->view().graph, expected_graph);
  graph::writeGraph(engine->view().graph, graph);
  EXPECT_EQ(graph.str(), expected_graph.str());
}

// Lasers that report up to 0.4 s late, with a different delay for each scan, so that scans overtake each other.
TEST(EngineOrder, ArrivalWithinTheWindowChangesNoBit) {
  const SimulatedLog log(halfALap());
  const auto ordered = makeEngine(kLaserIni);
  testing::run(*ordered, log.observations());
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    testing::Dice dice(seed);
    std::vector<std::pair<base::Stamp, CObservation::Ptr>> arrivals;
    for (const auto& observation : log.observations()) {
      const bool scan = IS_CLASS(*observation, CObservation2DRangeScan);
      const double delay = scan ? dice.uniform(0, 0.4) : 0.01;
      arrivals.emplace_back(observation->timestamp + base::durationFromSeconds(delay), observation);
    }
    std::sort(arrivals.begin(), arrivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto shuffled = makeEngine(kLaserIni);
    std::size_t overtaken = 0;
    base::Stamp newest;
    for (const auto& [arrival, observation] : arrivals) {
      overtaken += observation->timestamp < newest;
      newest = std::max(newest, observation->timestamp);
      shuffled->add(observation);
    }
    shuffled->finish();
    EXPECT_GT(overtaken, arrivals.size() / 10);
    EXPECT_EQ(bitsOf(shuffled->view()), bitsOf(ordered->view()));
  }
}

TEST(EngineThreads, OneTwoAndFourWorkersGiveTheSameBits) {
  const auto observations = SimulatedLog(halfALap()).observations();
  std::string one;
  for (const int threads : {1, 2, 4}) {
    const auto engine = makeEngine(kLaserIni, {}, threads);
    testing::run(*engine, observations);
    const std::string bits = bitsOf(engine->view());
    if (threads == 1) one = bits;
    EXPECT_TRUE(bits == one) << threads << " workers";
  }
}

// Odometry that is slower than the window: scans wait for it instead of being linked without it.
TEST(EngineOrder, OdometrySlowerThanTheWindowIsWaitedFor) {
  auto options = halfALap();
  options.odometry_rate = 1;
  const SimulatedLog log(options);
  const auto engine = makeEngine(kLaserIni);
  testing::run(*engine, log.observations());
  const auto view = engine->view();
  EXPECT_GT(view.map.key_frames.size(), 10U);
  for (const auto& [id, record] : view.graph.factors()) EXPECT_NE(record.tags.owner, "no_motion");
}

TEST(EngineConnection, OdometryThatFallsSilentDoesNotHoldUpTheMapForGood) {
  const SimulatedLog simulated(halfALap());
  auto log = simulated.observations();
  const auto silence = simulated.begin() + base::durationFromSeconds(2);
  log.erase(std::remove_if(log.begin(), log.end(),
                           [&](const auto& o) { return o->sensorLabel == "odometry" && o->timestamp > silence; }),
            log.end());
  const auto engine = makeEngine(kLaserIni);
  for (const auto& observation : log) engine->add(observation);
  const auto& newest = engine->view().map.key_frames.back();
  EXPECT_LT(base::secondsBetween(newest.stamp, log.back()->timestamp), 3) << "before the end of the log is known";
  engine->finish();
  EXPECT_EQ(map::denseTrajectory(engine->view().map).back().stamp, log.back()->timestamp);
  EXPECT_LT(testing::trajectoryError(engine->view(), simulated), 0.1) << "scan matching measures the missing odometry";
}

TEST(EngineConnection, WithoutAnyMotionOneKeyFrameStandsAndTheRestIsCounted) {
  auto log = SimulatedLog(halfALap()).observations();
  log.erase(std::remove_if(log.begin(), log.end(), [](const auto& o) { return IS_CLASS(*o, CObservationOdometry); }),
            log.end());
  const auto engine = makeEngine(kLaserIni, {"mapper.pose_plugins=odometry"});
  testing::run(*engine, log);
  EXPECT_EQ(engine->view().map.key_frames.size(), 1U);
  EXPECT_GT(engine->view().counts.unconnected, 5U);
}

TEST(EngineConnection, ScansBeyondTheOdometryAreCountedWhereNothingBridges) {
  const SimulatedLog simulated(halfALap());
  auto log = simulated.observations();
  const auto last = simulated.end() - base::durationFromSeconds(0.8);
  log.erase(std::remove_if(log.begin(), log.end(),
                           [&](const auto& o) { return o->sensorLabel == "odometry" && o->timestamp > last; }),
            log.end());
  const auto engine = makeEngine(kLaserIni, {"mapper.pose_plugins=odometry"});
  testing::run(*engine, log);
  const auto scans = std::count_if(log.begin(), log.end(), [](const auto& o) { return o->sensorLabel == "laser"; });
  EXPECT_GE(engine->view().counts.unconnected, 7U);
  EXPECT_EQ(map::denseTrajectory(engine->view().map).size() + engine->view().counts.unconnected,
            static_cast<std::size_t>(scans));
}

TEST(EngineConnection, WhereOdometryIsMissingTheNullMotionBridgesIt) {
  const SimulatedLog simulated(halfALap());
  auto log = simulated.observations();
  const auto from = simulated.begin() + base::durationFromSeconds(5), to = from + base::durationFromSeconds(1);
  // Separate motions, so that those of the gap are missing and not included in the next reading.
  std::vector<CObservation::Ptr> broken;
  mrpt::poses::CPose2D last;
  base::Stamp last_stamp;
  for (const auto& observation : log) {
    const auto* odometry = dynamic_cast<const CObservationOdometry*>(observation.get());
    if (!odometry) {
      broken.push_back(observation);
      continue;
    }
    auto motion = std::make_shared<obs::CObservationRelativeMotion>();
    motion->begin = last_stamp;
    motion->timestamp = odometry->timestamp;
    motion->begin_from_end = mrpt::poses::CPose3D(odometry->odometry - last);
    if (base::isValid(last_stamp) && (motion->timestamp < from || motion->begin > to)) broken.push_back(motion);
    last = odometry->odometry;
    last_stamp = odometry->timestamp;
  }
  const auto engine = makeEngine(kLaserIni, {"mapper.pose_plugins=odometry, no_motion"});
  testing::run(*engine, broken);
  std::size_t bridges = 0, links = 0;
  for (const auto& [id, record] : engine->view().graph.factors()) {
    bridges += record.tags.owner == "no_motion";
    links += record.tags.owner == "no_motion" || record.tags.owner == "odometry";
  }
  EXPECT_EQ(links + 1, engine->view().map.key_frames.size());
  EXPECT_GE(bridges, 4U);
  EXPECT_LE(bridges, 9U) << "only across the gap";
  const auto with_laser = makeEngine(kLaserIni);
  testing::run(*with_laser, broken);
  EXPECT_LT(testing::trajectoryError(with_laser->view(), simulated), 0.05) << "the laser measures the missing odometry";
}

TEST(EngineQueue, HoldsNoMoreThanItsLimitWhateverTheWindow) {
  SimulatedLogOptions options;
  options.laps = 0.2;
  const auto log = SimulatedLog(options).observations();
  const auto engine = makeEngine(kLaserIni, {"mapper.window_s=1000000", "mapper.queue_limit=20"});
  for (const auto& observation : log) engine->add(observation);
  EXPECT_GT(engine->view().counts.hurried, 20U);
  EXPECT_GT(engine->view().map.key_frames.size(), 5U) << "worked on while the log was read";
  engine->finish();
  const auto patient = makeEngine(kLaserIni);
  testing::run(*patient, log);
  EXPECT_EQ(engine->view().map.key_frames.size(), patient->view().map.key_frames.size());
}

}  // namespace
}  // namespace omnimapper::mapper::engine_input_test
