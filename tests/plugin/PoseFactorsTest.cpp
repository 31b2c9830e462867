#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <cmath>

namespace omnimapper::mapper::pose_factors_test {
namespace {

using mrpt::poses::CPose3D;
using Covariance = Eigen::Matrix<double, 6, 6>;

Covariance diagonal(double position, double angle) {
  Covariance covariance = Covariance::Zero();
  covariance.diagonal() << position, position, position, angle, angle, angle;
  return covariance;
}

void expectNear(const CPose3D& a, const CPose3D& b, double tolerance) {
  const auto difference = minus(geometry::fromMrpt(a), geometry::fromMrpt(b));
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), tolerance) << a << " " << b;
}

TEST(PoseFactors, APoseSurvivesTheGraphWholeInSpaceAndItsPlanarPartInThePlane) {
  const CPose3D pose(1, -2, 3, 2.5, -0.4, 1.2);
  graph::Graph graph;
  const auto spatial = graph.addVariable(poseVariable(Motion::spatial), poseValue(Motion::spatial, pose));
  const auto planar = graph.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, pose));
  expectNear(poseOf(graph, spatial), pose, 1e-12);
  expectNear(poseOf(graph, planar), CPose3D(1, -2, 0, 2.5, 0, 0), 1e-12);
}

// A motion and a prior have their minimum where the poses agree with the measurements.
TEST(PoseFactors, MotionsAndPriorsHoldPosesWhereTheyWereMeasured) {
  for (const Motion motion : {Motion::planar, Motion::spatial}) {
    const bool planar = motion == Motion::planar;
    const CPose3D first = planar ? CPose3D(1, 2, 0, 0.3, 0, 0) : CPose3D(1, 2, 0.5, 0.3, -0.2, 0.1);
    const CPose3D step = planar ? CPose3D(0.5, -0.2, 0, 0.7, 0, 0) : CPose3D(0.5, -0.2, 0.1, 0.7, 0.3, -0.5);
    graph::Graph graph;
    const auto a = graph.addVariable(poseVariable(motion), poseValue(motion, {}));
    const auto b = graph.addVariable(poseVariable(motion), poseValue(motion, {}));
    const auto prior = graph.addFactor(posePrior(motion, a, first, diagonal(0.01, 0.01), "prior"));
    const auto link = graph.addFactor(betweenPoses(motion, a, b, {step, diagonal(0.04, 0.01)}, "wheels"));
    EXPECT_GT(graph.whitenedResidual(link).norm(), 1);
    graph::solve(graph);
    EXPECT_LT(graph.whitenedResidual(prior).norm(), 1e-6);
    EXPECT_LT(graph.whitenedResidual(link).norm(), 1e-6);
    expectNear(poseOf(graph, a), first, 1e-6);
    expectNear(poseOf(graph, b), first + step, 1e-6);
    EXPECT_EQ(graph.factor(link).tags.owner, "wheels");
    EXPECT_EQ(graph.factor(prior).tags.owner, "prior");
  }
}

TEST(PoseFactors, AResidualIsCountedInStandardDeviations) {
  graph::Graph graph;
  const auto a = graph.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, {}), true);
  const auto b =
      graph.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, CPose3D(1.3, 0, 0, 0, 0, 0)));
  const auto link =
      graph.addFactor(betweenPoses(Motion::planar, a, b, {CPose3D(1, 0, 0, 0, 0, 0), diagonal(0.01, 0.01)}, "x"));
  EXPECT_NEAR(graph.whitenedResidual(link).norm(), 3, 1e-9);  // 0.3 m at 0.1 m
}

TEST(PoseFactors, WhatIsReportedAsExactIsGivenALeastVariance) {
  for (const Motion motion : {Motion::planar, Motion::spatial}) {
    graph::Graph graph;
    const auto a = graph.addVariable(poseVariable(motion), poseValue(motion, {}), true);
    const auto b = graph.addVariable(poseVariable(motion), poseValue(motion, {}));
    const auto link = graph.addFactor(betweenPoses(motion, a, b, {CPose3D(), Covariance::Zero()}, "x"));
    const Eigen::VectorXd sigmas = graph.factor(link).noise.covariance().diagonal().cwiseSqrt();
    const double least_angle = 0.001 * geometry::kPi / 180;
    EXPECT_NEAR(sigmas[0], 1e-4, 1e-9);
    EXPECT_NEAR(sigmas[sigmas.size() - 1], least_angle, 1e-9);
  }
}

TEST(PoseFactors, WhatIsNoCovarianceCountsByItsVariances) {
  Covariance contradiction = diagonal(0.04, 0.01);
  contradiction(0, 1) = contradiction(1, 0) = 1;  // the correlation is impossible: 25 instead of at most 1
  graph::Graph graph;
  const auto a = graph.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, {}), true);
  const auto b = graph.addVariable(poseVariable(Motion::planar), poseValue(Motion::planar, {}));
  const auto link = graph.addFactor(betweenPoses(Motion::planar, a, b, {CPose3D(), contradiction}, "x"));
  const Eigen::MatrixXd noise = graph.factor(link).noise.covariance();
  EXPECT_NEAR((noise - Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal().toDenseMatrix()).norm(), 0, 1e-9);
}

TEST(PoseFactors, AtAQuarterTurnUpTheRotationStaysWhole) {
  const CPose3D pose(0, 0, 0, 0.4, geometry::kPi / 2, 0);
  graph::Graph graph;
  const auto id = graph.addVariable(poseVariable(Motion::spatial), poseValue(Motion::spatial, pose));
  expectNear(poseOf(graph, id), pose, 1e-7);
}

}  // namespace
}  // namespace omnimapper::mapper::pose_factors_test
