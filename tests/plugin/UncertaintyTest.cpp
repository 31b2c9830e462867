#include <gtest/gtest.h>
#include <omnimapper/plugin/Uncertainty.h>
#include <omnimapper/testing/HandMadeRun.h>

namespace omnimapper::mapper::uncertainty_test {
namespace {

using mrpt::poses::CPose3D;
using testing::HandMadeRun;
using Covariance = Eigen::Matrix<double, 6, 6>;

// A robot that moves 1 m along x from key frame to key frame, each time with sigmas of 0.1 m and 0.01 rad.
class UncertaintyOf : public ::testing::TestWithParam<Motion> {
 protected:
  UncertaintyOf() { run_.motion = GetParam(); }

  void addFrames(int count) {
    for (int i = 0; i < count; ++i) {
      const double x = static_cast<double>(run_.map.key_frames.size());
      run_.addFrame(CPose3D(x, 0, 0, 0, 0, 0));
      if (x > 0) link(run_.map.key_frames.size() - 2, run_.map.key_frames.size() - 1);
    }
  }
  void link(std::size_t from, std::size_t to) {
    Covariance covariance = 0.01 * Covariance::Identity();
    covariance.bottomRightCorner<3, 3>() *= 0.01;
    const auto& frames = run_.map.key_frames;
    run_.graph.addFactor(betweenPoses(GetParam(), frames[from].pose, frames[to].pose,
                                      {frames[to].map_from_base - frames[from].map_from_base, covariance}, "test"));
  }
  Covariance between(unsigned from, unsigned to) {
    const auto covariance = run_.view().covarianceBetween({0, from}, {0, to});
    EXPECT_TRUE(covariance);
    return covariance.value_or(Covariance::Zero());
  }
  static void expectSteps(const Covariance& covariance, int steps) {
    double levers = 0;  // variance of the end by the rotation error of each step
    for (int i = 0; i < steps; ++i) levers += i * i;
    EXPECT_NEAR(covariance(0, 0), 0.01 * steps, 1e-9);
    EXPECT_NEAR(covariance(1, 1), 0.01 * steps + 1e-4 * levers, 1e-9);
    EXPECT_NEAR(covariance(5, 5), 1e-4 * steps, 1e-9);
    EXPECT_NEAR(covariance(1, 5), 1e-4 * steps * (steps - 1) / 2, 1e-9);
    const bool planar = GetParam() == Motion::planar;
    EXPECT_NEAR(covariance(2, 2), planar ? 0 : 0.01 * steps + 1e-4 * levers, 1e-9);
    EXPECT_NEAR(covariance(3, 3), planar ? 0 : 1e-4 * steps, 1e-9);
  }
  // As after a solve.
  void factor() { run_.uncertainty = Uncertainty(run_.graph); }

  HandMadeRun run_;
};

TEST_P(UncertaintyOf, AChainIsAsWorkedByHand) {
  addFrames(6);
  factor();
  expectSteps(between(0, 5), 5);
  expectSteps(between(2, 5), 3);
  expectSteps(between(4, 5), 1);
}

TEST_P(UncertaintyOf, KeyFramesAfterTheLastSolveAreReachedStepByStep) {
  addFrames(4);
  factor();
  expectSteps(between(1, 3), 2);
  addFrames(4);
  expectSteps(between(1, 7), 6);  // from before the solve to after it
  expectSteps(between(3, 6), 3);
  expectSteps(between(5, 7), 2);  // both after it
}

TEST_P(UncertaintyOf, ASecondFactorOfAStepCountsToo) {
  addFrames(3);
  factor();
  addFrames(1);
  link(2, 3);
  EXPECT_NEAR(between(2, 3)(0, 0), 0.005, 1e-9) << "two measurements, half the variance";
}

TEST_P(UncertaintyOf, AClosureCountsFromTheNextSolveOn) {
  addFrames(8);
  factor();
  const double open = between(0, 7)(0, 0);
  link(0, 7);
  EXPECT_NEAR(between(0, 7)(0, 0), open, 1e-12);
  factor();
  EXPECT_NEAR(between(0, 7)(0, 0), 1 / (1 / 0.07 + 1 / 0.01), 1e-9);
}

TEST_P(UncertaintyOf, WhatNothingDeterminesIsNotKnown) {
  addFrames(3);
  run_.graph.setFixed(run_.map.key_frames.front().pose, false);
  factor();
  EXPECT_FALSE(run_.view().covarianceBetween({0, 0}, {0, 2})) << "the whole map is unconstrained";
}

INSTANTIATE_TEST_SUITE_P(Motions, UncertaintyOf, ::testing::Values(Motion::planar, Motion::spatial));

}  // namespace
}  // namespace omnimapper::mapper::uncertainty_test
