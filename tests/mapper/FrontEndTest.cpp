#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "SteadyMotion.h"
#include "front_end/FrontEnd.h"

// Observations come in any order, and bundles leave in order of time: comments of a robot that moves at 1 m/s.
namespace omnimapper::mapper::front_end_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;
using testing::at;

constexpr int kPipelineDepth = 8;  // bundles that wait for their perception

// Throws once, when it is to process a certain stamp.
class Fragile : public testing::Steady {
 public:
  void processUntil(base::Stamp stamp) override {
    if (stamp == bad) throw std::runtime_error("cannot process this one");
  }
  base::Stamp bad;
};

class Wanting : public MeasurementPlugin {
 public:
  bool wants(const CObservation&) const override { return true; }
  Batch measure(const map::KeyFrame&, const Observed&, const View&) override { return {}; }
};

class FrontEndOfComments : public ::testing::Test {
 protected:
  FrontEndOfComments() {
    auto fragile = std::make_unique<Fragile>();
    source_ = fragile.get();
    plugins_.pose.push_back({"steady", std::move(fragile)});
    plugins_.measurement.push_back({"wanting", std::make_unique<Wanting>()});
    settings_.trigger.every_observation = true;
    settings_.engine.window = 0.5;
    chain_.beginSession({0, "test", {}, true}, std::nullopt, false);
  }
  void make() {
    schedule_ = std::make_unique<Schedule>();
    front_end_ = std::make_unique<FrontEnd>(settings_, SensorPoses(), plugins_, chain_, pool_, *schedule_, state_);
  }
  void add(double seconds) {
    auto comment = CObservationComment::Create();
    comment->timestamp = at(seconds);
    comment->sensorLabel = "notes";
    front_end_->add({comment});
  }
  /// Appends the bundles that are released now to `all`, by their time [ms]. Each gets its key frame, as in the back
  /// end.
  void take(std::vector<long>& all) {
    while (auto bundle = front_end_->next()) {
      all.push_back(std::lround(1e3 * base::secondsBetween(at(0), bundle->stamp)));
      chain_.place(bundle->stamp);
    }
  }
  std::vector<long> takeRest() {
    std::vector<long> all;
    front_end_->close();
    take(all);
    return all;
  }

  EngineSettings settings_;
  PluginSet plugins_;
  Fragile* source_;
  RunState state_;
  PoseChain chain_{Motion::planar, plugins_.pose, state_.map, state_.graph};
  std::unique_ptr<Schedule> schedule_;
  std::unique_ptr<FrontEnd> front_end_;
  base::WorkerPool pool_{1};
};

TEST_F(FrontEndOfComments, ABundleIsHandedOutWhenEightYoungerOnesWaitBehindIt) {
  make();
  std::vector<long> all;
  for (int i = 0; i < 12; ++i) {
    add(i);
    take(all);
    // The newest observation still waits in its window.
    EXPECT_EQ(static_cast<int>(all.size()), std::max(0, i - kPipelineDepth)) << "after " << i;
  }
  front_end_->close();
  take(all);
  EXPECT_EQ(all, (std::vector<long>{0, 1000, 2000, 3000, 4000, 5000, 6000, 7000, 8000, 9000, 10000, 11000}));
}

TEST_F(FrontEndOfComments, WithinTheWindowTheOrderOfArrivalPlaysNoPart) {
  make();
  std::vector<long> all;
  for (const double stamp : {0.0, 1.2, 0.9, 1.0, 2.0}) {
    add(stamp);
    take(all);
  }
  EXPECT_TRUE(all.empty());
  EXPECT_EQ(takeRest(), (std::vector<long>{0, 900, 1000, 1200, 2000}));
  EXPECT_EQ(state_.counts.late, 0U);
}

TEST_F(FrontEndOfComments, WhatComesAfterItsWindowStandsBehindYoungerOnesAndIsCounted) {
  make();
  std::vector<long> all;
  for (const double stamp : {0.0, 1.0, 2.0, 0.5}) {
    add(stamp);
    take(all);
  }
  EXPECT_TRUE(front_end_->oldestWaiting() == at(0));
  EXPECT_EQ(takeRest(), (std::vector<long>{0, 1000, 500, 2000}));
  EXPECT_EQ(state_.counts.late, 1U);
  EXPECT_FALSE(front_end_->oldestWaiting());
}

TEST_F(FrontEndOfComments, MoreThanTheLimitDoNotWaitForTheirWindow) {
  settings_.engine.window = 100;
  settings_.engine.queue_limit = 3;
  make();
  std::vector<long> all;
  for (int i = 0; i < 5; ++i) {
    add(i);
    take(all);
  }
  EXPECT_EQ(state_.counts.hurried, 2U);
}

TEST_F(FrontEndOfComments, WhatASourceThrowsCostsThatStampAndNoOther) {
  make();
  source_->bad = at(1);
  for (int i = 0; i < 3; ++i) add(i);
  EXPECT_THROW(takeRest(), std::runtime_error);
  EXPECT_EQ(takeRest(), (std::vector<long>{0, 2000}));
}

}  // namespace
}  // namespace omnimapper::mapper::front_end_test
