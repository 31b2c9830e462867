#include <gtest/gtest.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/Association.h>

namespace omnimapper::mapper::association_test {
namespace {

using geometry::Se2;
using graph::SquareRootInformation;
using Kind = Match::Kind;
using Method = AssociationOptions::Method;

// Points of a map that are known well, and a pose whose position is known only poorly.
class AssociationOfPoints : public ::testing::Test {
 protected:
  AssociationOfPoints() {
    pose_ = graph_.addVariable(graph::se2(), Eigen::Vector3d::Zero());
    graph_.addFactor({{pose_},
                      std::make_shared<graph::PriorSe2>(Se2{}),
                      SquareRootInformation::fromSigmas(Eigen::Vector3d(0.6, 0.6, 1e-4))});
  }

  void mapPoint(double x, double y) {
    const auto id = graph_.addVariable(graph::point2(), Eigen::Vector2d(x, y));
    graph_.addFactor({{pose_, id},
                      std::make_shared<graph::PointFactor2>(Eigen::Vector2d(x, y)),
                      SquareRootInformation::fromSigmas(Eigen::Vector2d(1e4, 1e4))});
    // As if the point was measured often: its position is known, whatever the pose.
    graph_.setFixed(id, true);
    points_.push_back(id);
  }
  // Every measurement may be of every point.
  Association associateAll(const std::vector<Eigen::Vector2d>& measured) const {
    std::vector<Pairing> pairings;
    for (std::size_t m = 0; m < measured.size(); ++m) {
      for (std::size_t i = 0; i < points_.size(); ++i) {
        graph::FactorRecord record{{pose_, points_[i]},
                                   std::make_shared<graph::PointFactor2>(measured[m]),
                                   SquareRootInformation::fromSigmas(Eigen::Vector2d(0.05, 0.05))};
        pairings.push_back({m, landmark(i), record});
      }
    }
    const Uncertainty uncertainty(graph_);
    return associate(measured.size(), pairings, {map_, graph_, uncertainty}, options_, repeats_);
  }
  static base::LandmarkId landmark(std::size_t i) { return {0, static_cast<std::uint32_t>(i)}; }
  // Number of the landmark that a measurement was matched with, -1 for none.
  int matchOf(const Association& found, std::size_t m) const {
    const Match& match = found.matches[m];
    return match.kind == Kind::matched ? static_cast<int>(*match.pairing % points_.size()) : -1;
  }

  graph::Graph graph_;
  map::Map map_;
  base::VariableId pose_;
  std::vector<base::VariableId> points_;
  AssociationOptions options_;
  Repeats repeats_ = Repeats::no;
};

// The pose is wrong by 0.9 m; the points are 1, 1.5 and 2 m apart. By itself, each measurement is nearest to the wrong
// one.
TEST_F(AssociationOfPoints, TogetherMatchWhatEachAloneMatchesWrong) {
  for (const double x : {0.0, 1.0, 2.5, 4.5}) mapPoint(x, 2);
  const std::vector<Eigen::Vector2d> measured = {{0.9, 2}, {1.9, 2}, {3.4, 2}, {5.4, 2}};
  const Association jointly = associateAll(measured);
  for (int m = 0; m < 4; ++m) EXPECT_EQ(matchOf(jointly, m), m);
  EXPECT_TRUE(jointly.complete);
  EXPECT_LT(jointly.chi2, jointly.limit);
  options_.method = Method::nearest;
  EXPECT_EQ(matchOf(associateAll(measured), 0), 1);
}

TEST_F(AssociationOfPoints, ChiSquareOfOneWorkedByHand) {
  mapPoint(0, 2);
  const Association found = associateAll({{0.6, 2}});
  EXPECT_NEAR(found.matches[0].chi2, 0.36 / (0.36 + 0.0025), 1e-3);  // the effect of the yaw is below
  EXPECT_NEAR(found.matches[0].limit, 13.816, 1e-3);                 // 99.9 %, two rows
  EXPECT_EQ(found.matches[0].kind, Kind::matched);
}

TEST_F(AssociationOfPoints, WhatIsFarFromAllIsNew) {
  mapPoint(0, 2);
  const Association found = associateAll({{4, 2}});
  EXPECT_EQ(found.matches[0].kind, Kind::unknown);
  EXPECT_GT(found.matches[0].chi2, found.matches[0].limit);
  Decision decision;
  found.matches[0].describe(decision);
  EXPECT_FALSE(decision.accepted);
  EXPECT_EQ(decision.reason, "gated out: too far from the nearest");
}

// Each passes its own gate, but not both together: if one is right, the other is wrong by a metre.
TEST_F(AssociationOfPoints, WhatDoesNotFitTogetherIsNotMatchedTogether) {
  mapPoint(0, 2);
  mapPoint(5, 2);
  mapPoint(5, -2);
  const Association found = associateAll({{0.1, 2}, {5.1, 2}, {6.2, -2}});
  EXPECT_EQ(matchOf(found, 0), 0);
  EXPECT_EQ(matchOf(found, 1), 1);
  EXPECT_EQ(found.matches[2].kind, Kind::unknown);
  EXPECT_LT(found.matches[2].chi2, found.matches[2].limit);
}

TEST_F(AssociationOfPoints, BetweenTwoAlikeAreAmbiguous) {
  mapPoint(-0.5, 2);
  mapPoint(0.5, 2);
  const Association found = associateAll({{0.02, 2}});
  EXPECT_EQ(found.matches[0].kind, Kind::ambiguous);
  EXPECT_LT(found.matches[0].likelihood_ratio, 2);
  ASSERT_TRUE(found.matches[0].rival);
  options_.min_likelihood_ratio = 1;
  EXPECT_EQ(matchOf(associateAll({{0.02, 2}}), 0), 1);
}

TEST_F(AssociationOfPoints, ALandmarkIsMetOnceUnlessItMayRepeat) {
  mapPoint(0, 2);
  const std::vector<Eigen::Vector2d> twice = {{0.01, 2}, {0.02, 2}};
  const Association once = associateAll(twice);
  EXPECT_EQ((matchOf(once, 0) == 0) + (matchOf(once, 1) == 0), 1);
  repeats_ = Repeats::yes;
  const Association both = associateAll(twice);
  EXPECT_EQ(matchOf(both, 0), 0);
  EXPECT_EQ(matchOf(both, 1), 0);
}

TEST_F(AssociationOfPoints, ASearchOutOfNodesGivesTheBestSoFarAndSaysSo) {
  for (int i = 0; i < 10; ++i) mapPoint(0.3 * i, 2);
  std::vector<Eigen::Vector2d> measured;
  for (int i = 0; i < 10; ++i) measured.emplace_back(0.3 * i + 0.05, 2);
  options_.max_nodes = 60;
  const Association found = associateAll(measured);
  EXPECT_FALSE(found.complete);
  EXPECT_LE(found.nodes, 70);
  for (int m = 0; m < 10; ++m) EXPECT_EQ(matchOf(found, static_cast<std::size_t>(m)), m);
  Decision decision;
  found.describe(3, decision);
  EXPECT_EQ(decision.reason, "matched; the search was cut short");
}

// For example, a landmark that only a removed factor of another session had bound.
TEST_F(AssociationOfPoints, ALandmarkThatNothingBindsIsNoneToMatch) {
  mapPoint(0, 2);
  points_.push_back(graph_.addVariable(graph::point2(), Eigen::Vector2d(0.6, 2)));
  const Association found = associateAll({{0.6, 2}});
  EXPECT_EQ(matchOf(found, 0), 0);
}

// The point is attached to an unconstrained pose, so its covariance relative to the first pose is undetermined.
TEST_F(AssociationOfPoints, WhereNothingIsKnownOfHowSureTheMapIsNothingIsMatched) {
  const auto adrift = graph_.addVariable(graph::se2(), Eigen::Vector3d::Zero());
  points_.push_back(graph_.addVariable(graph::point2(), Eigen::Vector2d(0, 2)));
  graph_.addFactor({{adrift, points_.back()},
                    std::make_shared<graph::PointFactor2>(Eigen::Vector2d(0, 2)),
                    SquareRootInformation::fromSigmas(Eigen::Vector2d(0.1, 0.1))});
  const Association found = associateAll({{0, 2}});
  EXPECT_EQ(found.matches[0].kind, Kind::undetermined);
  Decision decision;
  found.describe(0, decision);
  EXPECT_FALSE(decision.accepted);
}

TEST_F(AssociationOfPoints, NothingToChooseFromIsAllNew) {
  const Association found = associateAll({{1, 1}, {2, 2}});
  EXPECT_EQ(found.matches[1].kind, Kind::unknown);
  EXPECT_FALSE(found.matches[1].pairing);
}

}  // namespace
}  // namespace omnimapper::mapper::association_test
