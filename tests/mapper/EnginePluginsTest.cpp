#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <functional>

#include "Engine.h"
#include "SteadyMotion.h"

// Tests the guarantees of the engine to plugins, with plugins made for this: a robot moves along x at 1 m/s, and the
// log has one comment per second, each a key frame.
namespace omnimapper::mapper::engine_plugins_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;
using mrpt::poses::CPose3D;
using testing::at;
using testing::Steady;

// A plugin scripted by each test.
class Scripted : public MeasurementPlugin {
 public:
  bool wants(const CObservation& observation) const override {
    return wants_any && dynamic_cast<const CObservationComment*>(&observation) != nullptr;
  }
  Batch measure(const map::KeyFrame& frame, const Observed&, const View& view) override {
    return on_measure ? on_measure(frame, view) : Batch();
  }
  bool givesAbsolutePoses() const override { return is_absolute; }
  bool worksOnLandmarks() const override { return !wants_any; }
  void applied(const AppliedBatch& ids) override { applied_ids.push_back(ids); }
  FollowUp afterCommit(const map::KeyFrame& frame, const View& view) override {
    return after_commit ? FollowUp{after_commit(frame, view), {}} : FollowUp();
  }

  std::function<Batch(const map::KeyFrame&, const View&)> on_measure, after_commit;
  std::vector<AppliedBatch> applied_ids;
  bool is_absolute = false, wants_any = true;
};

class CountingOutput : public OutputPlugin {
 public:
  explicit CountingOutput(bool fails) : fails_(fails) {}
  void update(const View&) override { ++updates; }
  void finish(const View&) override {
    ++finishes;
    if (fails_) throw base::Error(base::ExitCode::disk_full, "no room");
  }
  int updates = 0, finishes = 0;

 private:
  bool fails_;
};

class EnginePlugins : public ::testing::Test {
 protected:
  EnginePlugins() {
    settings_.engine.solve_every = 1000;
    auto scripted = std::make_unique<Scripted>();
    plugin_ = scripted.get();
    set_.pose.push_back({"steady", std::make_unique<Steady>()});
    set_.measurement.push_back({"scripted", std::move(scripted)});
  }
  Scripted* addPlugin(const std::string& section) {
    auto scripted = std::make_unique<Scripted>();
    auto* pointer = scripted.get();
    set_.measurement.push_back({section, std::move(scripted)});
    return pointer;
  }
  CountingOutput* addOutput(bool fails) {
    auto output = std::make_unique<CountingOutput>(fails);
    auto* pointer = output.get();
    set_.output.push_back({"output", std::move(output)});
    return pointer;
  }
  Engine& run(int key_frames) {
    settings_.trigger.every_observation = true;
    engine_ = std::make_unique<Engine>(settings_, "scripted", SensorPoses(), std::move(set_), 1);
    engine_->setStop(stop_);
    for (int i = 0; i < key_frames; ++i) {
      auto comment = CObservationComment::Create();
      comment->timestamp = at(i);
      engine_->add(comment);
    }
    engine_->finish();
    return *engine_;
  }

  EngineSettings settings_;
  std::function<bool()> stop_;
  PluginSet set_;
  Scripted* plugin_;
  std::unique_ptr<Engine> engine_;
};

graph::FactorRecord link(base::VariableId a, base::VariableId b, double distance) {
  return betweenPoses(Motion::planar, a, b,
                      {CPose3D(distance, 0, 0, 0, 0, 0), 0.01 * Eigen::Matrix<double, 6, 6>::Identity()}, "scripted");
}

TEST_F(EnginePlugins, FinalIdsReachThePluginAndItsLaterBatchesMayUseThem) {
  plugin_->on_measure = [this](const map::KeyFrame& frame, const View& view) {
    EXPECT_EQ(frame.id, view.map.key_frames.back().id) << "measured at the newest key frame";
    Batch batch;
    const auto landmark = plugin_->applied_ids.empty()
                              ? batch.addVariable(poseVariable(Motion::planar), Eigen::Vector3d(9, 0, 0))
                              : plugin_->applied_ids.front().variables.front();
    batch.addFactor(link(frame.pose, landmark, 10 - static_cast<double>(frame.id.index)));
    return batch;
  };
  const auto view = run(5).view();
  ASSERT_EQ(plugin_->applied_ids.size(), 5U);
  const auto landmark = plugin_->applied_ids.front().variables.front();
  EXPECT_FALSE(Batch::isProvisional(landmark));
  EXPECT_EQ(view.graph.factorsOf(landmark).size(), 5U);
  EXPECT_NEAR(view.graph.value(landmark).x(), 10, 1e-6) << "solved at the end";
}

TEST_F(EnginePlugins, AfterCommitComesOncePerKeyFrameWhenItsFactorsAreInTheGraph) {
  std::vector<base::KeyFrameId> committed;
  plugin_->on_measure = [](const map::KeyFrame& frame, const View& view) {
    Batch batch;
    if (frame.id.index > 0) batch.addFactor(link(view.map.key_frames.front().pose, frame.pose, frame.id.index));
    return batch;
  };
  plugin_->after_commit = [&](const map::KeyFrame& frame, const View& view) {
    committed.push_back(frame.id);
    Batch batch;
    if (frame.id.index == 0) return batch;
    EXPECT_EQ(view.graph.factorsOf(frame.pose).size(), 2U) << "the odometry's and its own";
    batch.removeFactor(view.graph.factorsOf(frame.pose).back());
    return batch;
  };
  const auto view = run(4).view();
  EXPECT_EQ(committed, (std::vector<base::KeyFrameId>{{0, 0}, {0, 1}, {0, 2}, {0, 3}}));
  EXPECT_EQ(view.graph.factors().size(), 3U) << "its own were taken out again";
}

TEST_F(EnginePlugins, SolvesEverySoManyKeyFramesAndAtTheEnd) {
  settings_.engine.solve_every = 10;
  const auto* output = addOutput(false);
  const auto view = run(35).view();
  std::vector<std::size_t> solved;
  for (const auto& solve : view.solves) solved.push_back(solve.key_frames);
  EXPECT_EQ(solved, (std::vector<std::size_t>{10, 20, 30, 35}));
  EXPECT_EQ(view.counts.solves, 4U);
  EXPECT_EQ(output->updates, 4);
}

TEST_F(EnginePlugins, AHypothesisBringsTheNextSolveForward) {
  settings_.engine.solve_every = 10;
  settings_.engine.solve_after_closure = 4;
  plugin_->on_measure = [](const map::KeyFrame& frame, const View& view) {
    Batch batch;
    if (frame.id.index != 11) return batch;  // the twelfth
    auto closure = link(view.map.key_frames.front().pose, frame.pose, 11);
    closure.tags.hypothesis = true;
    batch.addFactor(closure);
    return batch;
  };
  std::vector<std::size_t> solved;
  for (const auto& solve : run(30).view().solves) solved.push_back(solve.key_frames);
  EXPECT_EQ(solved, (std::vector<std::size_t>{10, 14, 24, 30}));
}

// Landmarks are searched for from the measured pose of the base, not from that of the odometry.
TEST_F(EnginePlugins, AMeasuredPoseMovesItsKeyFrameBeforeThePluginsThatFollow) {
  const auto measured = [](std::uint32_t index) { return CPose3D(index, 2, 0, 0, 0, 0); };
  plugin_->is_absolute = true;
  plugin_->on_measure = [&](const map::KeyFrame& frame, const View&) {
    Batch batch;
    batch.addFactor(posePrior(Motion::planar, frame.pose, measured(frame.id.index),
                              1e-4 * Eigen::Matrix<double, 6, 6>::Identity(), "scripted"));
    return batch;
  };
  int seen = 0;
  addPlugin("follows")->on_measure = [&](const map::KeyFrame& frame, const View& view) {
    EXPECT_NEAR(frame.map_from_base.y(), 2, 0.05) << frame.id.index;
    EXPECT_NEAR(poseOf(view.graph, frame.pose).y(), 2, 0.05);
    ++seen;
    return Batch();
  };
  run(5);
  EXPECT_EQ(seen, 5);
}

TEST_F(EnginePlugins, ThoseThatNothingCameToAreNamedUnlessTheyWorkOnLandmarks) {
  addPlugin("of_landmarks")->wants_any = false;
  EXPECT_TRUE(run(3).idlePlugins().empty());
}

TEST_F(EnginePlugins, WithoutAnyObservationAllThatWorkOnSomeAreIdle) {
  addPlugin("second");
  addPlugin("of_landmarks")->wants_any = false;
  EXPECT_EQ(run(0).idlePlugins(), (std::vector<std::string>{"scripted", "second"}));
}

TEST_F(EnginePlugins, AnOutputThatFailsKeepsNoOtherFromItsOwn) {
  auto *first = addOutput(true), *second = addOutput(false);
  auto& engine = run(3);
  const auto failures = engine.writeOutputs();
  ASSERT_EQ(failures.size(), 1);
  EXPECT_EQ(failures.front().code(), base::ExitCode::disk_full);
  EXPECT_EQ(first->finishes, 1);
  EXPECT_EQ(second->finishes, 1);
}

TEST_F(EnginePlugins, EveryPosePluginThatCoversTheSpanLinksTheKeyFrames) {
  set_.pose.push_back({"second", std::make_unique<Steady>()});
  const auto view = run(6).view();
  std::map<std::string, int> links;
  for (const auto& [id, record] : view.graph.factors()) ++links[record.tags.owner];
  EXPECT_EQ(links, (std::map<std::string, int>{{"steady", 5}, {"second", 5}}));
}

TEST_F(EnginePlugins, AnInvalidBatchIsAnErrorThatLeavesTheGraphWhole) {
  plugin_->on_measure = [](const map::KeyFrame& frame, const View&) {
    Batch batch;
    batch.addVariable(poseVariable(Motion::planar), Eigen::Vector3d::Zero());
    if (frame.id.index == 2) batch.addFactor(link(frame.pose, {0, 999}, 1));
    return batch;
  };
  EXPECT_THROW(run(5), base::Error);
  const auto view = engine_->view();
  EXPECT_EQ(view.map.key_frames.size(), 5U) << "the others are worked off all the same";
  EXPECT_EQ(view.graph.variables().size(), 5U + 4U) << "nothing of the bad batch";
}

TEST_F(EnginePlugins, AnExtractorThatFailsIsReportedAndTheRunGoesOn) {
  class Failing : public perception::Extractor {
   public:
    bool wants(const CObservation&) const override { return true; }
    std::vector<CObservation::Ptr> extract(const CObservation& raw) const override {
      if (raw.timestamp == at(1)) throw base::Error(base::ExitCode::unreadable_input, "cannot make sense of it");
      return {};
    }
  };
  set_.extractors.push_back({"failing", std::make_unique<Failing>()});
  run(3);
  const auto view = engine_->view();
  EXPECT_EQ(view.map.key_frames.size(), 3U);
  EXPECT_EQ(engine_->extractionErrors().code(), base::ExitCode::damaged_input);
  ASSERT_EQ(view.warnings.size(), 1U);
  for (const auto& word : {std::string("1 observation"), base::formatUnix(at(1), 6), std::string("cannot make sense")})
    EXPECT_NE(view.warnings[0].find(word), std::string::npos) << word << ": " << view.warnings[0];
}

TEST_F(EnginePlugins, AJobThatFailsCostsNeitherTheOtherJobsNorTheLastSolve) {
  class Failing : public Scripted {
   public:
    FollowUp afterCommit(const map::KeyFrame& frame, const View&) override {
      FollowUp follow_up;
      follow_up.jobs.push_back({"job", [index = frame.id.index](const State&) -> Batch {
                                  if (index == 3) throw base::Error(base::ExitCode::damaged_input, "a bad job");
                                  Batch batch;
                                  batch.addVariable(poseVariable(Motion::planar), Eigen::Vector3d::Zero());
                                  return batch;
                                }});
      return follow_up;
    }
  };
  settings_.engine.job_delay = 1000;  // all at the end
  set_.measurement.clear();
  set_.measurement.push_back({"failing", std::make_unique<Failing>()});
  EXPECT_THROW(run(20), base::Error);
  const auto view = engine_->view();
  EXPECT_EQ(view.map.key_frames.size(), 20U);
  EXPECT_EQ(view.graph.variables().size(), 20U + 19U);
  EXPECT_GE(view.counts.solves, 1U);
}

TEST_F(EnginePlugins, AnInterruptedRunLeavesWhatIsNotJudgedUnjudged) {
  settings_.engine.solve_after_closure = 1000;
  plugin_->on_measure = [](const map::KeyFrame& frame, const View& view) {
    Batch batch;
    if (frame.id.index != 11) return batch;
    Decision decision;
    decision.kind = "loop closure";
    decision.is_loop_closure = true;
    batch.addHypothesis(link(view.map.key_frames.front().pose, frame.pose, 11), decision);
    return batch;
  };
  stop_ = [] { return true; };
  const auto view = run(15).view();
  ASSERT_EQ(view.decisions.size(), 1U);
  EXPECT_FALSE(view.decisions.front().accepted);
  EXPECT_NE(view.decisions.front().reason.find("interrupted"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::mapper::engine_plugins_test
