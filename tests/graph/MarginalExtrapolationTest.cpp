#include <gtest/gtest.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "omnimapper/graph/MarginalExtrapolation.h"

namespace omnimapper::graph::grown_marginals_test {
namespace {

using base::VariableId;
using geometry::Se2;

const auto kNoise3 = SquareRootInformation::fromSigmas(Eigen::Vector3d(0.1, 0.1, 0.02));
const auto kNoise2 = SquareRootInformation::fromSigmas(Eigen::Vector2d(0.05, 0.05));

// A pose 1 m ahead of another.
VariableId drive(Graph& graph, VariableId from) {
  const Se2 next = se2FromValue(graph.value(from).data()) * Se2{1, 0, 0.1};
  const VariableId id = graph.addVariable(se2(), toValue(next));
  graph.addFactor({{from, id}, std::make_shared<BetweenSe2>(Se2{1, 0, 0.1}), kNoise3});
  return id;
}

void see(Graph& graph, VariableId from, VariableId point) {
  const Se2 pose = se2FromValue(graph.value(from).data());
  const Eigen::Vector2d seen = inverse(pose) * Eigen::Vector2d(graph.value(point));
  graph.addFactor({{from, point}, std::make_shared<PointFactor2>(seen), kNoise2});
}

struct Drive {
  Graph graph;
  std::vector<VariableId> poses, points;

  Drive() {
    poses.push_back(graph.addVariable(se2(), Eigen::Vector3d::Zero()));
    graph.addFactor({{poses[0]}, std::make_shared<PriorSe2>(Se2{}), kNoise3});
    for (int i = 0; i < 4; ++i) poses.push_back(drive(graph, poses.back()));
    points.push_back(graph.addVariable(point2(), Eigen::Vector2d(3, 1)));
    for (const VariableId pose : poses) see(graph, pose, points[0]);
  }
};

TEST(MarginalExtrapolation, AreTheMarginalsWhereNothingCameSince) {
  const Drive drive;
  const Marginals marginals(drive.graph);
  const std::vector<VariableId> ids = {drive.points[0], drive.poses[2]};
  EXPECT_TRUE(jointCovariance(marginals, drive.graph, ids)->isApprox(marginals.jointCovariance(ids)));
}

TEST(MarginalExtrapolation, WhereTheTrajectoryOnlyWentOnAreThoseOfTheWholeGraph) {
  Drive before;
  const Marginals marginals(before.graph);
  const VariableId next = drive(before.graph, before.poses.back()), last = drive(before.graph, next);
  const VariableId point = before.graph.addVariable(point2(), Eigen::Vector2d(6, 0));
  see(before.graph, next, point);
  const std::vector<VariableId> ids = {last, before.points[0], point, next, before.poses[1]};
  const auto joint = jointCovariance(marginals, before.graph, ids);
  ASSERT_TRUE(joint);
  EXPECT_TRUE(joint->isApprox(Marginals(before.graph).jointCovariance(ids), 1e-9));
}

TEST(MarginalExtrapolation, WhereOldLandmarksAreSeenAgainAreNotSmallerThanThoseOfTheWholeGraph) {
  Drive before;
  const Marginals marginals(before.graph);
  const VariableId next = drive(before.graph, before.poses.back());
  see(before.graph, next, before.points[0]);
  const std::vector<VariableId> ids = {next, before.points[0]};
  const auto joint = jointCovariance(marginals, before.graph, ids);
  ASSERT_TRUE(joint);
  const Eigen::MatrixXd more = *joint - Marginals(before.graph).jointCovariance(ids);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(more).eigenvalues().minCoeff(), -1e-12);
  EXPECT_LT((*joint)(0, 0), jointCovariance(marginals, before.graph, {before.poses.back()})->trace());
}

// Farther than what is used first: without landmarks, the whole path matters; with them, only its last part.
TEST(MarginalExtrapolation, AfterALongPathAreThoseOfTheWholeGraphOrALittleMore) {
  for (const bool sees_landmarks : {false, true}) {
    Drive before;
    std::vector<VariableId> points;
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector2d place(10 * std::cos(i), 10 * std::sin(i));
      points.push_back(before.graph.addVariable(point2(), place, true));
    }
    const Marginals marginals(before.graph);
    VariableId last = before.poses.back();
    for (int i = 0; i < 200; ++i) {
      last = drive(before.graph, last);
      if (!sees_landmarks) continue;
      see(before.graph, last, points[i % 40]);
      see(before.graph, last, points[(i + 7) % 40]);
    }
    const auto joint = jointCovariance(marginals, before.graph, {last});
    ASSERT_TRUE(joint);
    const Eigen::MatrixXd whole = Marginals(before.graph).jointCovariance({last});
    EXPECT_TRUE(joint->isApprox(whole, 1e-6)) << *joint << "\n\n" << whole;
    if (!sees_landmarks) continue;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(*joint - whole).eigenvalues().minCoeff(), -1e-12);
  }
}

TEST(MarginalExtrapolation, AFixedVariableHasNone) {
  Drive before;
  const Marginals marginals(before.graph);
  const VariableId held = before.graph.addVariable(point2(), Eigen::Vector2d(1, 1), true);
  const auto joint = jointCovariance(marginals, before.graph, {held, before.points[0]});
  ASSERT_TRUE(joint);
  EXPECT_TRUE(joint->topRows(2).isZero());
  EXPECT_GT((*joint)(2, 2), 0);
}

TEST(MarginalExtrapolation, WhatNothingDeterminesHasNone) {
  Drive before;
  const Marginals marginals(before.graph);
  const VariableId loose = before.graph.addVariable(point2(), Eigen::Vector2d(1, 1));
  EXPECT_FALSE(jointCovariance(marginals, before.graph, {loose}));
  EXPECT_FALSE(jointCovariance(marginals, before.graph, {VariableId{7, 7}}));
}

}  // namespace
}  // namespace omnimapper::graph::grown_marginals_test
