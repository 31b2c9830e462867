#include <gtest/gtest.h>
#include <omnimapper/graph/VariableKinds.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "back_end/JobQueue.h"

namespace omnimapper::mapper::job_queue_test {
namespace {

// A batch that contains the number of variables of the state.
Job counting(const std::string& name, int milliseconds = 0) {
  return {name, [milliseconds](const State& state) {
            std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
            Batch batch;
            for (std::size_t i = 0; i < state.graph.variables().size(); ++i) batch.retireLandmark({});
            return batch;
          }};
}

std::shared_ptr<const Snapshot> snapshotOf(const graph::Graph& graph) {
  return std::make_shared<const Snapshot>(Snapshot{{}, graph, {}});
}

class JobQueueOf : public ::testing::TestWithParam<int> {};

TEST_P(JobQueueOf, JobsAreTakenInOrderWhenTheyAreDueWhicheverIsDoneFirst) {
  base::WorkerPool pool(GetParam());
  JobQueue jobs(pool, 3);
  jobs.add(10, {"owner", {}}, {0, 9}, counting("slow", 20), snapshotOf(graph::Graph()));
  jobs.add(11, {"owner", {}}, {0, 10}, counting("quick"), snapshotOf(graph::Graph()));
  EXPECT_FALSE(jobs.take(12, false));
  const auto first = jobs.take(13, false);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->name, "slow");
  EXPECT_EQ(first->frame, (base::KeyFrameId{0, 9}));
  EXPECT_FALSE(jobs.take(13, false));
  EXPECT_EQ(jobs.take(13, true)->name, "quick") << "at the end of the log";
  EXPECT_FALSE(jobs.take(13, true));
}

TEST_P(JobQueueOf, AJobSeesTheStateItWasGivenWhateverHappensAfterwards) {
  base::WorkerPool pool(GetParam());
  JobQueue jobs(pool, 0);
  graph::Graph graph;
  const auto id = graph.addVariable(graph::point2(), Eigen::Vector2d::Zero());
  for (int i = 0; i < 50; ++i) {
    jobs.add(0, {"owner", {}}, {}, counting("job"), snapshotOf(graph));
    graph.addVariable(graph::point2(), Eigen::Vector2d(i, 0));
    graph.setValue(id, Eigen::Vector2d(i, i));
  }
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(jobs.take(0, false)->batch.retiredLandmarks().size(), i + 1);
}

TEST_P(JobQueueOf, WhatAJobThrowsComesOutWhenItIsTakenAndTheOthersGoOn) {
  base::WorkerPool pool(GetParam());
  JobQueue jobs(pool, 0);
  jobs.add(0, {}, {}, {"bad", [](const State&) -> Batch { throw std::runtime_error("cannot"); }},
           snapshotOf(graph::Graph()));
  jobs.add(0, {}, {}, counting("good"), snapshotOf(graph::Graph()));
  EXPECT_THROW(jobs.take(0, false), std::runtime_error);
  EXPECT_EQ(jobs.take(0, false)->name, "good");
}

INSTANTIATE_TEST_SUITE_P(Threads, JobQueueOf, ::testing::Values(1, 2, 4));

}  // namespace
}  // namespace omnimapper::mapper::job_queue_test
