#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

#include "back_end/SlidingWindow.h"

// A session in a map that is held: the information of its retired key frames must neither get lost nor count twice.
namespace omnimapper::mapper::sliding_window_test {
namespace {

using mrpt::poses::CPose3D;

constexpr int kMapFrames = 4;

// Key frames of a map on a line, and a session that passes them and measures each of its poses from the nearest.
class Session {
 public:
  Session() {
    map_.sessions.push_back({0, "map", {}, true});
    for (int i = 0; i < kMapFrames; ++i) addFrame(0, i, CPose3D(2.0 * i, 1, 0, 0, 0, 0));
    graph_.addFactor(posePrior(Motion::planar, frame(0).pose, frame(0).map_from_base, covariance(0.1), "engine"));
    window_.holdMap();
    map_.sessions.push_back({1, "session", {}, true});
    graph_.setSession(1);
    const CPose3D start(0.1, -0.1, 0, 0.05, 0, 0);
    map_.sessions[1].anchor = graph_.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, start));
    graph_.addFactor(posePrior(Motion::planar, map_.sessions[1].anchor, start, covariance(0.5), "engine"));
  }

  void drive(int steps) {
    for (int i = 0; i < steps; ++i, ++driven_) {
      const CPose3D truth(0.5 * driven_, 0.1 * std::sin(driven_), 0, 0.05 * driven_, 0, 0);
      const auto before = driven_ == 0 ? map_.sessions[1].anchor : map_.key_frames.back().pose;
      const CPose3D step = driven_ == 0 ? CPose3D() : noisy(truth - last_, 0.02);
      const double sigma = driven_ == 0 ? 0.001 : 0.03;
      const auto id = addFrame(1, driven_, driven_ == 0 ? truth : map_.key_frames.back().map_from_base + step);
      const auto pose = map_.keyFrame(id).pose;
      graph_.addFactor(betweenPoses(Motion::planar, before, pose, {step, covariance(sigma)}, "odometry"));
      if (driven_ % 3 == 2) {
        const auto& near = frame(driven_ % kMapFrames);
        const auto measured = noisy(truth - near.map_from_base, 0.04);
        graph_.addFactor(betweenPoses(Motion::planar, near.pose, pose, {measured, covariance(0.05)}, "closure"));
      }
      last_ = truth;
    }
  }

  graph::Graph graph_;
  map::Map map_;
  SlidingWindow window_{Motion::planar, 3, map_, graph_};
  const map::KeyFrame& frame(int i) const { return map_.key_frames[static_cast<std::size_t>(i)]; }
  base::VariableId newest() const { return map_.key_frames.back().pose; }

 private:
  static Eigen::Matrix<double, 6, 6> covariance(double sigma) {
    return sigma * sigma * Eigen::Matrix<double, 6, 6>::Identity();
  }
  CPose3D noisy(const CPose3D& pose, double sigma) {
    return pose + CPose3D(dice_.normal(sigma), dice_.normal(sigma), 0, dice_.normal(0.2 * sigma), 0, 0);
  }
  base::KeyFrameId addFrame(std::uint16_t session, int second, const CPose3D& map_from_base) {
    map::KeyFrame frame;
    frame.id = map_.key_frames.nextId(session);
    frame.stamp = base::stampFromUnix(1e9 + 1000.0 * session + second);
    frame.map_from_base = map_from_base;
    frame.pose = graph_.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, map_from_base));
    map_.key_frames.insert(frame);
    return frame.id;
  }
  testing::Dice dice_{5};
  CPose3D last_;
  int driven_ = 0;
};

const base::Stamp kLater = base::stampFromUnix(2e9);

TEST(SlidingWindow, RetiredKeyFramesLeaveTheirInformationAndNoMore) {
  Session whole, windowed;
  for (int i = 0; i < 12; ++i) {
    whole.drive(1);
    windowed.drive(1);
    graph::solve(whole.graph_);
    graph::solve(windowed.graph_);
    windowed.window_.retire(kLater);
  }
  const auto a = poseOf(whole.graph_, whole.newest()), b = poseOf(windowed.graph_, windowed.newest());
  EXPECT_LT((a.translation() - b.translation()).norm(), 1e-3);
  EXPECT_NEAR(a.yaw(), b.yaw(), 1e-3);
  const auto of_whole = graph::Marginals(whole.graph_).covariance(whole.newest());
  const auto of_window = graph::Marginals(windowed.graph_).covariance(windowed.newest());
  EXPECT_LT((of_whole - of_window).norm(), 0.01 * of_whole.norm()) << of_whole << "\n\n" << of_window;
}

TEST(SlidingWindow, TheMapStaysInEveryBitAndTheGraphDoesNotGrow) {
  Session session;
  const Session untouched;
  std::size_t most = 0;
  for (int i = 0; i < 60; ++i) {
    session.drive(1);
    graph::solve(session.graph_);
    session.window_.retire(kLater);
    most = std::max(most, session.graph_.factors().size());
  }
  EXPECT_EQ(session.window_.held(), kMapFrames + 60U - 3U);
  EXPECT_LT(most, 12U);
  for (int i = 0; i < kMapFrames; ++i) {
    EXPECT_EQ(session.graph_.value(session.frame(i).pose), untouched.graph_.value(untouched.frame(i).pose));
  }
}

TEST(SlidingWindow, NothingRetiresUntilWhatAlignedTheSessionHasStood) {
  Session session;
  session.drive(15);
  session.map_.sessions[1].aligned_at = session.frame(kMapFrames + 8).id;
  EXPECT_TRUE(session.window_.retire(kLater).empty()) << "6 key frames ago";
  session.drive(5);
  EXPECT_FALSE(session.window_.hasRetired());
  EXPECT_EQ(session.window_.retire(kLater).size(), 17U);
  EXPECT_TRUE(session.window_.hasRetired());
}

TEST(SlidingWindow, NothingRetiresBeforeTheSessionIsAlignedNorWhatIsTooNew) {
  Session session;
  session.map_.sessions[1].aligned = false;
  session.drive(10);
  EXPECT_TRUE(session.window_.retire(kLater).empty());
  session.map_.sessions[1].aligned = true;
  EXPECT_TRUE(session.window_.retire(session.frame(kMapFrames).stamp).empty());
  EXPECT_EQ(session.window_.retire(session.frame(kMapFrames + 3).stamp).size(), 2U);
  EXPECT_EQ(session.window_.retire(kLater).size(), 5U);
}

}  // namespace
}  // namespace omnimapper::mapper::sliding_window_test
