#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <string>
#include <vector>

#include "front_end/ReleaseQueue.h"

namespace omnimapper::mapper::release_queue_test {
namespace {

using mrpt::obs::CObservation;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

CObservation::Ptr observation(double seconds, const std::string& label = "a") {
  auto made = mrpt::obs::CObservationComment::Create();
  made->timestamp = at(seconds);
  made->sensorLabel = label;
  return made;
}

// Adds an observation as the engine does; returns whether it was accepted.
bool give(ReleaseQueue& queue, const CObservation::Ptr& observation) {
  queue.arrived(observation->timestamp);
  return queue.add(observation);
}

std::vector<base::Stamp> released(ReleaseQueue& queue, bool drain) {
  std::vector<base::Stamp> stamps;
  while (drain ? queue.size() > 0 : queue.due().has_value()) stamps.push_back(queue.next()->stamp);
  return stamps;
}

TEST(Queue, HoldsAnObservationUntilTheNewestIsAWindowLater) {
  ReleaseQueue queue(base::durationFromSeconds(0.5));
  EXPECT_TRUE(give(queue, observation(0)));
  EXPECT_TRUE(released(queue, false).empty());
  EXPECT_TRUE(give(queue, observation(0.4)));
  EXPECT_TRUE(released(queue, false).empty());
  queue.arrived(at(0.5));
  EXPECT_EQ(released(queue, false), std::vector{at(0)});
  queue.arrived(at(0.2));
  EXPECT_TRUE(released(queue, false).empty()) << "a late one releases nothing";
  EXPECT_EQ(released(queue, true), std::vector{at(0.4)});
  EXPECT_EQ(queue.size(), 0U);
}

TEST(Queue, AnyArrivalWithinTheWindowLeavesInOrderOfStamp) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    testing::Dice dice(seed);
    std::vector<std::pair<double, double>> arrivals;  // arrival, stamp
    for (int i = 0; i < 500; ++i) arrivals.emplace_back(0.01 * i + dice.uniform(0, 0.49), 0.01 * i);
    std::sort(arrivals.begin(), arrivals.end());
    ReleaseQueue queue(base::durationFromSeconds(0.5));
    std::vector<base::Stamp> order;
    for (const auto& [arrival, stamp] : arrivals) {
      EXPECT_TRUE(give(queue, observation(stamp)));
      for (const auto out : released(queue, false)) order.push_back(out);
    }
    EXPECT_GT(order.size(), 400U) << "released while the log runs, not at its end";
    for (const auto out : released(queue, true)) order.push_back(out);
    ASSERT_EQ(order.size(), arrivals.size());
    for (std::size_t i = 1; i < order.size(); ++i) EXPECT_LT(order[i - 1], order[i]);
  }
}

TEST(Queue, WhatComesAfterItsStampWasReleasedIsRefused) {
  ReleaseQueue queue(base::durationFromSeconds(0.5));
  give(queue, observation(1));
  give(queue, observation(2));
  EXPECT_EQ(released(queue, false), std::vector{at(1)});
  EXPECT_FALSE(give(queue, observation(0.9)));
  EXPECT_FALSE(give(queue, observation(1))) << "its group has left";
  EXPECT_TRUE(give(queue, observation(1.1))) << "late, but nothing after it was released";
  EXPECT_EQ(released(queue, true), (std::vector{at(1.1), at(2)}));
}

TEST(Queue, ObservationsOfOneStampLeaveTogetherInOrderOfArrival) {
  ReleaseQueue queue(base::durationFromSeconds(0));
  give(queue, observation(1, "rear"));
  give(queue, observation(1, "front"));
  give(queue, observation(1, "gps"));
  ASSERT_EQ(queue.due(), at(1));
  const auto group = queue.next();
  ASSERT_TRUE(group);
  ASSERT_EQ(group->observations.size(), 3U);
  EXPECT_EQ(group->observations[0]->sensorLabel, "rear");
  EXPECT_EQ(group->observations[1]->sensorLabel, "front");
  EXPECT_EQ(group->observations[2]->sensorLabel, "gps");
  EXPECT_FALSE(queue.next());
}

TEST(Queue, AStampFromTheFarFutureReleasesNothingOnceItHasPassed) {
  ReleaseQueue queue(base::durationFromSeconds(0.5));
  give(queue, observation(1e8));
  give(queue, observation(1));
  EXPECT_TRUE(released(queue, false).empty());
  give(queue, observation(1.5));
  EXPECT_EQ(released(queue, false), std::vector{at(1)});
}

TEST(Queue, KnowsWhatWaitsByLabelClassAndStamp) {
  ReleaseQueue queue(base::durationFromSeconds(0.5));
  give(queue, observation(1, "a"));
  EXPECT_TRUE(queue.holds(*observation(1, "a")));
  EXPECT_FALSE(queue.holds(*observation(1, "b")));
  EXPECT_FALSE(queue.holds(*observation(1.1, "a")));
  mrpt::obs::CObservationOdometry other_class;
  other_class.timestamp = at(1);
  other_class.sensorLabel = "a";
  EXPECT_FALSE(queue.holds(other_class));
}

}  // namespace
}  // namespace omnimapper::mapper::release_queue_test
