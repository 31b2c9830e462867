#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <functional>

#include "Engine.h"
#include "SteadyMotion.h"

// Plugins that see observations of which no key frame is made. A robot moves along x at 1 m/s; the observations "frame"
// make the key frames, one each second, and a person beside the robot gives commands in between.
namespace omnimapper::mapper::watch_test {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationComment;
using testing::at;
using testing::Steady;

CObservationComment::Ptr comment(const std::string& label, double seconds, const std::string& text = "") {
  auto made = CObservationComment::Create();
  made->sensorLabel = label;
  made->timestamp = at(seconds);
  made->text = text;
  return made;
}

// The names that a person gave, as a layer.
struct Names {
  static constexpr char kLayer[] = "names";
  static constexpr std::uint32_t kLayerVersion = 1;
  std::string all;
  std::string toBytes() const { return all; }
};

// Measures at every "frame", and watches the labels of `watched`.
class Watcher : public MeasurementPlugin, public WatchesObservations {
 public:
  explicit Watcher(std::set<std::string> watched) : watched_(std::move(watched)) {}
  bool wants(const CObservation& observation) const override { return observation.sensorLabel == "frame"; }
  Batch measure(const map::KeyFrame&, const Observed&, const View&) override {
    ++measured;
    return {};
  }
  bool watches(const CObservation& observation) const override { return watched_.count(observation.sensorLabel) > 0; }
  void arrived(const CObservation& observation) override { arrivals += text(observation); }
  WatchResult watch(const Watched& watched, const View& view) override {
    seen += text(watched.observation);
    return on_watch ? on_watch(watched, view) : WatchResult();
  }
  static std::string text(const CObservation& observation) {
    return dynamic_cast<const CObservationComment&>(observation).text;
  }

  std::function<WatchResult(const Watched&, const View&)> on_watch;
  std::string arrivals, seen;
  int measured = 0;

 private:
  std::set<std::string> watched_;
};

class Watch : public ::testing::Test {
 protected:
  Watch() {
    settings_.engine.solve_every = 1000;
    settings_.trigger.every_observation = true;
    set_.pose.push_back({"steady", std::make_unique<Steady>()});
  }
  Watcher* add(const std::string& section, std::set<std::string> watched) {
    auto watcher = std::make_unique<Watcher>(std::move(watched));
    auto* pointer = watcher.get();
    set_.measurement.push_back({section, std::move(watcher)});
    return pointer;
  }
  View run(const std::vector<CObservationComment::Ptr>& observations) {
    engine_ = std::make_unique<Engine>(settings_, "watched", SensorPoses(), std::move(set_), 1);
    for (const auto& observation : observations) engine_->add(observation);
    engine_->finish();
    return engine_->view();
  }

  EngineSettings settings_;
  PluginSet set_;
  std::unique_ptr<Engine> engine_;
};

TEST_F(Watch, whatMakesNoKeyFrameIsSeenInOrderWithThePoseOfItsStamp) {
  auto* watcher = add("watcher", {"person"});
  std::vector<double> positions, since;
  std::vector<std::uint32_t> frames;
  watcher->on_watch = [&](const Watched& watched, const View& view) {
    if (watched.pose) {
      positions.push_back(watched.pose->map_from_base.x());
      since.push_back(watched.pose->frame_from_base.begin_from_end.x());
      frames.push_back(watched.pose->frame.index);
      EXPECT_EQ(view.map.key_frames.back().id, watched.pose->frame) << "no younger key frame is in the map yet";
    }
    return WatchResult();
  };
  // The person's observation of 1.25 s comes after that of 1.5 s, within the window.
  const auto view =
      run({comment("person", -0.5, "early "), comment("frame", 0), comment("frame", 1), comment("person", 1.5, "b "),
           comment("person", 1.25, "a "), comment("frame", 2), comment("person", 2, "c ")});
  EXPECT_EQ(watcher->arrivals, "early b a c ");
  EXPECT_EQ(watcher->seen, "early a b c ");
  EXPECT_EQ(view.map.key_frames.size(), 3u) << "the person makes none";
  EXPECT_EQ(watcher->measured, 3);
  ASSERT_EQ(positions.size(), 3u) << "before the first key frame there is no pose";
  EXPECT_NEAR(positions[0], 1.25, 1e-9);
  EXPECT_NEAR(positions[1], 1.5, 1e-9);
  EXPECT_NEAR(positions[2], 2, 1e-9);
  EXPECT_NEAR(since[0], 0.25, 1e-9);
  EXPECT_NEAR(since[2], 0, 1e-9);
  EXPECT_EQ(frames, (std::vector<std::uint32_t>{1, 1, 2}));
  EXPECT_EQ(view.counts.unwanted, 0u);
  EXPECT_EQ(view.counts.not_triggered, 0u) << "only what perception wants goes to the trigger";
}

TEST_F(Watch, theAnswerMayMeasureOrSetALayer) {
  auto* watcher = add("watcher", {"person"});
  watcher->on_watch = [](const Watched& watched, const View& view) {
    WatchResult result;
    const auto& pose = *watched.pose;
    // A post at x = 10, measured from where the base was.
    const auto post = result.batch.addVariable(poseVariable(Motion::planar), Eigen::Vector3d(9, 0, 0));
    const mrpt::poses::CPose3D from_base(10 - pose.map_from_base.x(), 0, 0, 0, 0, 0);
    result.batch.addFactor(betweenPoses(
        Motion::planar, view.map.keyFrame(pose.frame).pose, post,
        {pose.frame_from_base.begin_from_end + from_base, 0.01 * Eigen::Matrix<double, 6, 6>::Identity()}, "watcher"));
    const auto* names = view.map.layers.find<Names>();
    result.batch.setLayer(Names{(names ? names->all : "") + Watcher::text(watched.observation)});
    return result;
  };
  const auto view = run({comment("frame", 0), comment("person", 0.5, "post "), comment("frame", 1)});
  ASSERT_TRUE(view.map.layers.find<Names>());
  EXPECT_EQ(view.map.layers.find<Names>()->all, "post ");
  double x = 0;
  for (const auto& [id, variable] : view.graph.variables()) x = std::max(x, variable.value.x());
  EXPECT_NEAR(x, 10, 1e-6);
}

TEST_F(Watch, anAnswerIsTakenLikeAnyObservation) {
  auto* asking = add("asking", {"person"});
  auto* listening = add("listening", {"command"});
  asking->on_watch = [](const Watched& watched, const View&) {
    return WatchResult{{}, {comment("command", 1.5, "go "), comment("frame", 1.5, Watcher::text(watched.observation))}};
  };
  const auto view =
      run({comment("frame", 0), comment("frame", 1), comment("person", 1.5, "wave "), comment("frame", 2)});
  EXPECT_EQ(listening->seen, "go ");
  EXPECT_EQ(asking->seen, "wave ");
  EXPECT_EQ(view.map.key_frames.size(), 4u) << "the answer made a key frame where the trigger would have made none";
  EXPECT_NEAR(view.map.key_frames[2].map_from_base.x(), 1.5, 1e-9);
}

TEST_F(Watch, manyObservationsBesideARobotThatRestsKeepNobodyWaiting) {
  auto* watcher = add("watcher", {"person"});
  engine_ = std::make_unique<Engine>(settings_, "watched", SensorPoses(), std::move(set_), 1);
  engine_->add(comment("frame", 0));
  for (int i = 1; i <= 100; ++i) {
    engine_->add(comment("person", 0.01 * i, "."));
    EXPECT_FALSE(engine_->isBusy());
  }
  engine_->finish();
  EXPECT_EQ(watcher->seen.size(), 100u);
}

TEST_F(Watch, pluginsThatAnswerEachOtherEnd) {
  auto* one = add("one", {"ping"});
  auto* other = add("other", {"pong"});
  one->on_watch = [](const Watched& watched, const View&) {
    const double later = base::secondsBetween(at(0), watched.observation.timestamp) + 0.001;
    return WatchResult{{}, {comment("pong", later, "o ")}};
  };
  other->on_watch = [](const Watched& watched, const View&) {
    const double later = base::secondsBetween(at(0), watched.observation.timestamp) + 0.001;
    return WatchResult{{}, {comment("ping", later, "i ")}};
  };
  const auto view = run({comment("frame", 0), comment("ping", 0.5, "i "), comment("frame", 1)});
  EXPECT_EQ(one->seen + other->seen, "i i i i i o o o o ");
  ASSERT_EQ(view.warnings.size(), 1u);
  EXPECT_NE(view.warnings[0].find("without end"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::mapper::watch_test
