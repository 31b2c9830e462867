#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include "../plugin/GraphInvariants.h"
#include "Engine.h"
#include "SteadyMotion.h"

// Runs the engine with a plugin that does everything a plugin may do, at random, on observations with random delays.
namespace omnimapper::mapper::engine_random_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;
using mrpt::poses::CPose3D;
using testing::at;
using testing::Dice;
using testing::Steady;

// Landmarks are poses ahead of the key frame that measured them.
class Random : public MeasurementPlugin {
 public:
  explicit Random(std::uint64_t seed) : dice_(seed) {}
  bool wants(const CObservation&) const override { return true; }

  Batch measure(const map::KeyFrame& frame, const Observed&, const View& view) override {
    testing::expectNothingDangles(view);
    return randomBatch(frame, view, dice_);
  }
  FollowUp afterCommit(const map::KeyFrame& frame, const View& view) override {
    FollowUp follow_up;
    if (chance(0.3)) follow_up.batch = randomBatch(frame, view, dice_);
    for (int i = 0; chance(0.3) && i < 3; ++i) {
      const auto seed = static_cast<std::uint64_t>(dice_.uniform(0, 1e9));
      follow_up.jobs.push_back({"random job", [seed, id = frame.id](const State& state) {
                                  Dice dice(seed);
                                  return randomBatch(state.map.keyFrame(id), state, dice);
                                }});
    }
    return follow_up;
  }

 private:
  bool chance(double share) { return dice_.uniform(0, 1) < share; }

  static graph::FactorRecord measurementOf(const map::KeyFrame& frame, base::VariableId landmark, double distance) {
    return betweenPoses(Motion::planar, frame.pose, landmark,
                        {CPose3D(distance, 0, 0, 0, 0, 0), 0.01 * Eigen::Matrix<double, 6, 6>::Identity()}, "random");
  }

  // Reads only its arguments, because jobs call it as well.
  static Batch randomBatch(const map::KeyFrame& frame, const State& state, Dice& dice) {
    Batch batch;
    const auto chance = [&](double share) { return dice.uniform(0, 1) < share; };
    const auto pick = [&](const auto& list) {
      return list[static_cast<std::size_t>(dice.uniform(0, static_cast<double>(list.size())))];
    };
    const auto landmarks = state.candidates("random");
    std::vector<base::FactorId> own;
    for (const auto& [id, record] : state.graph.factors()) {
      if (record.tags.owner == "random") own.push_back(id);
    }
    if (chance(0.5)) {
      // Gates call it in the engine's thread and in those of jobs.
      const auto covariance = state.covarianceBetween(state.map.key_frames.front().id, frame.id);
      EXPECT_TRUE(!covariance || covariance->allFinite());
    }
    if (chance(0.3)) {
      const auto variable = batch.addVariable(poseVariable(Motion::planar), Eigen::Vector3d(dice.uniform(0, 50), 0, 0));
      const auto landmark = batch.addLandmark("thing", {variable});
      auto seen = measurementOf(frame, variable, dice.uniform(1, 3));
      seen.tags.landmark = landmark;
      batch.addFactor(std::move(seen));
    }
    if (!landmarks.empty() && chance(0.7)) {
      const auto id = pick(landmarks);
      auto seen = measurementOf(frame, state.map.landmark(id).variables.front(), dice.uniform(1, 3));
      seen.tags.landmark = id;
      batch.addFactor(std::move(seen));
      batch.addEvidence(id);
    }
    if (state.map.key_frames.size() > 3 && chance(0.2)) {
      const auto& other =
          state.map
              .key_frames[static_cast<std::size_t>(dice.uniform(0, static_cast<double>(state.map.key_frames.size())))];
      if (other.id != frame.id) {
        const double truth = base::secondsBetween(other.stamp, frame.stamp);
        Decision decision;
        decision.kind = "loop closure";
        decision.is_loop_closure = true;
        decision.from = frame.id;
        decision.to = other.id;
        batch.addHypothesis(
            betweenPoses(Motion::planar, other.pose, frame.pose,
                         {CPose3D(truth + (dice.uniform(0, 1) < 0.5 ? 0 : dice.uniform(-20, 20)), 0, 0, 0, 0, 0),
                          0.01 * Eigen::Matrix<double, 6, 6>::Identity()},
                         "random"),
            decision);
      }
    }
    if (!own.empty() && chance(0.2)) batch.removeFactor(pick(own));
    if (!own.empty() && chance(0.2)) {
      const auto id = pick(own);
      if (!state.graph.factor(id).tags.hypothesis) batch.setWeight(id, dice.uniform(0, 2));
    }
    if (landmarks.size() > 2 && chance(0.1)) {
      const auto from = pick(landmarks), into = pick(landmarks);
      const bool evident = std::any_of(batch.evidence().begin(), batch.evidence().end(),
                                       [&](const auto& e) { return e.landmark == from; });
      if (from != into && !evident) batch.mergeLandmarks(from, into);
    } else if (!landmarks.empty() && chance(0.05)) {
      batch.retireLandmark(pick(landmarks));
    }
    return batch;
  }

  Dice dice_;
};

std::unique_ptr<Engine> run(std::uint64_t seed, int threads, int count) {
  EngineSettings settings;
  settings.trigger.every_observation = true;
  settings.engine.solve_every = 25;
  PluginSet set;
  set.pose.push_back({"steady", std::make_unique<Steady>()});
  set.measurement.push_back({"random", std::make_unique<Random>(seed)});
  auto engine = std::make_unique<Engine>(settings, "random", SensorPoses(), std::move(set), threads);
  // A comment every 0.2 s, each delayed by up to six windows; sometimes two with one stamp.
  Dice dice(seed + 1000);
  std::multimap<double, CObservation::Ptr> arrivals;
  for (int i = 0; i < count; ++i) {
    auto comment = CObservationComment::Create();
    comment->timestamp = at(0.2 * (i - (i % 7 == 0)));
    comment->sensorLabel = i % 7 == 0 ? "second" : "first";
    arrivals.emplace(0.2 * i + dice.uniform(0, 6 * settings.engine.window), comment);
  }
  for (const auto& [arrival, comment] : arrivals) engine->add(comment);
  engine->finish();
  return engine;
}

TEST(EngineRandom, WhateverPluginsDoTheTrajectoryIsOneChainAndNothingDangles) {
  for (std::uint64_t seed = 1; seed <= (testing::kIsSanitized ? 3 : 25); ++seed) {
    const auto engine = run(seed, 2, 150);
    const auto view = engine->view();
    testing::expectOneChain(view, {"steady"});
    testing::expectNothingDangles(view);
    EXPECT_EQ(view.map.key_frames.size(), 150U - 150 / 7) << "two of one stamp share a key frame";
    EXPECT_GT(view.counts.spliced, 10U);
    if (HasFailure()) FAIL() << "with seed " << seed;
  }
}

TEST(EngineRandom, JobsAndSplicesGiveTheSameBitsWithAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= (testing::kIsSanitized ? 1 : 5); ++seed) {
    const std::string bits = testing::bitsOf(run(seed, 1, 150)->view());
    EXPECT_EQ(testing::bitsOf(run(seed, 2, 150)->view()), bits);
    EXPECT_EQ(testing::bitsOf(run(seed, 5, 150)->view()), bits);
  }
}

}  // namespace
}  // namespace omnimapper::mapper::engine_random_test
