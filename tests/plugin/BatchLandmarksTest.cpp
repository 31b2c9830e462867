#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/State.h>

#include <functional>

#include "GraphInvariants.h"

// The effect of batches on landmarks. Two landmarks, a and b, are seen from one pose.
namespace omnimapper::mapper::batch_landmarks_test {
namespace {

using map::Landmark;

graph::FactorRecord measurement(base::VariableId pose, base::VariableId thing, base::LandmarkId landmark) {
  graph::FactorRecord record{{pose, thing},
                             std::make_shared<graph::BetweenSe2>(geometry::Se2{1, 0, 0}),
                             graph::SquareRootInformation::identity(3),
                             {},
                             1,
                             {}};
  record.tags.landmark = landmark;
  return record;
}

base::Stamp at(double seconds) {
  return base::stampFromUnix(1e9 + seconds);
}

class BatchLandmarks : public ::testing::Test {
 protected:
  BatchLandmarks() {
    Batch batch;
    for (int i = 0; i < 2; ++i) {
      const auto variable = batch.addVariable(graph::se2(), Eigen::Vector3d(1, i, 0));
      const auto landmark = batch.addLandmark("thing", {variable});
      batch.addFactor(measurement(pose_, variable, landmark));
    }
    const auto applied = apply(batch, {"finder", at(1)}, graph_, map_);
    a_ = applied.landmarks.at(0);
    b_ = applied.landmarks.at(1);
    seen_a_ = applied.factors.at(0);
    seen_b_ = applied.factors.at(1);
  }
  AppliedBatch applied(const std::function<void(Batch&)>& edit, double seconds = 2) {
    Batch batch;
    edit(batch);
    return apply(batch, {"finder", at(seconds)}, graph_, map_);
  }
  void expectRefused(const std::function<void(Batch&)>& edit, const std::string& word) {
    const auto factors = graph_.factors().size(), variables = graph_.variables().size();
    try {
      applied(edit);
      FAIL() << "not refused: " << word;
    } catch (const base::Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
    EXPECT_EQ(graph_.factors().size(), factors);
    EXPECT_EQ(graph_.variables().size(), variables);
    EXPECT_EQ(map_.landmarks.size(), 2U);
  }
  State state() const { return {map_, graph_, uncertainty_}; }
  base::VariableId variableOf(base::LandmarkId id) const { return map_.landmarks.find(id)->variables.front(); }

  map::Map map_;
  graph::Graph graph_;
  Uncertainty uncertainty_;
  base::VariableId pose_ = graph_.addVariable(graph::se2(), Eigen::Vector3d::Zero(), true);
  base::LandmarkId a_, b_;
  base::FactorId seen_a_, seen_b_;
};

TEST_F(BatchLandmarks, ANewOneKnowsItsOwnerItsVariablesAndItsFirstEvidence) {
  const auto& landmark = map_.landmark(a_);
  EXPECT_EQ(landmark.kind, "thing");
  EXPECT_EQ(landmark.owner, "finder");
  EXPECT_EQ(landmark.evidence, 1U);
  EXPECT_EQ(landmark.first_seen, at(1));
  EXPECT_TRUE(graph_.contains(variableOf(a_)));
  EXPECT_EQ(graph_.factor(seen_a_).tags.landmark, a_) << "the provisional id became the final one";
  EXPECT_EQ(state().factorsOf(a_), std::vector<base::FactorId>{seen_a_});
  EXPECT_EQ(state().candidates("finder"), (std::vector<base::LandmarkId>{a_, b_}));
  EXPECT_TRUE(state().candidates("somebody else").empty());
}

TEST_F(BatchLandmarks, EvidenceCountsAndMovesTheStampsOutwards) {
  applied([&](Batch& batch) { batch.addEvidence(a_); }, 5);
  applied([&](Batch& batch) { batch.addEvidence(a_); }, 0.5);
  EXPECT_EQ(map_.landmark(a_).evidence, 3U);
  EXPECT_EQ(map_.landmark(a_).first_seen, at(0.5));
  EXPECT_EQ(map_.landmark(a_).last_seen, at(5));
}

TEST_F(BatchLandmarks, ARetiredOneKeepsItsFactorsAndIsNoCandidate) {
  applied([&](Batch& batch) { batch.retireLandmark(a_); });
  EXPECT_EQ(map_.landmark(a_).state, Landmark::State::retired);
  EXPECT_EQ(state().candidates("finder"), std::vector<base::LandmarkId>{b_});
  EXPECT_TRUE(graph_.contains(seen_a_));
}

TEST_F(BatchLandmarks, MergingGivesFactorsAndEvidenceToTheOther) {
  applied([&](Batch& batch) { batch.addEvidence(b_); }, 7);
  const auto gone = variableOf(b_);
  applied([&](Batch& batch) { batch.mergeLandmarks(b_, a_); });
  EXPECT_FALSE(graph_.contains(gone));
  EXPECT_EQ(graph_.factor(seen_b_).variables.back(), variableOf(a_)) << "under its old id";
  EXPECT_EQ(graph_.factor(seen_b_).tags.landmark, a_);
  EXPECT_EQ(map_.landmark(b_).id, a_) << "who asks for the one gets the other";
  EXPECT_EQ(map_.landmark(a_).evidence, 3U);
  EXPECT_EQ(map_.landmark(a_).last_seen, at(7));
  EXPECT_EQ(state().factorsOf(b_), (std::vector<base::FactorId>{seen_a_, seen_b_}));
  testing::expectNothingDangles(state());
}

TEST_F(BatchLandmarks, OneTakesInSeveralAndOneThatGoesTakesInNone) {
  expectRefused(
      [&](Batch& batch) {
        batch.mergeLandmarks(b_, a_);
        batch.mergeLandmarks(b_, a_);
      },
      "twice");
  expectRefused(
      [&](Batch& batch) {
        batch.mergeLandmarks(b_, a_);
        batch.mergeLandmarks(a_, b_);
      },
      "cannot have others merged into it");
  const auto third = applied([&](Batch& batch) {
                       const auto variable = batch.addVariable(graph::se2(), Eigen::Vector3d::Zero());
                       batch.addFactor(measurement(pose_, variable, batch.addLandmark("thing", {variable})));
                     }).landmarks.front();
  applied([&](Batch& batch) {
    batch.mergeLandmarks(b_, a_);
    batch.mergeLandmarks(third, a_);
  });
  EXPECT_EQ(map_.landmark(third).id, a_);
  EXPECT_EQ(map_.landmark(b_).id, a_);
  EXPECT_EQ(state().factorsOf(a_).size(), 3U);
  testing::expectNothingDangles(state());
}

TEST_F(BatchLandmarks, AFactorBetweenTwoThatAreMergedGoes) {
  const auto both =
      applied([&](Batch& batch) { batch.addFactor(measurement(variableOf(a_), variableOf(b_), a_)); }).factors.front();
  applied([&](Batch& batch) { batch.mergeLandmarks(b_, a_); });
  EXPECT_FALSE(graph_.contains(both));
  testing::expectNothingDangles(state());
}

TEST_F(BatchLandmarks, AVariableGoesOnlyWithTheFactorsThatBindIt) {
  const auto extra = applied([&](Batch& batch) {
    const auto variable = batch.addVariable(graph::se2(), Eigen::Vector3d::Zero());
    batch.addFactor(measurement(pose_, variable, a_));
  });
  expectRefused([&](Batch& batch) { batch.removeVariable(extra.variables[0]); }, "still bound");
  applied([&](Batch& batch) {
    batch.removeFactor(extra.factors[0]);
    batch.removeVariable(extra.variables[0]);
  });
  EXPECT_FALSE(graph_.contains(extra.variables[0]));
}

TEST_F(BatchLandmarks, WhatDoesNotFitIsRefusedWithItsReason) {
  expectRefused([&](Batch& batch) { batch.addEvidence({0, 9}); }, "no landmark 0:9");
  expectRefused([&](Batch& batch) { batch.mergeLandmarks(a_, a_); }, "the same");
  expectRefused([&](Batch& batch) { batch.retireLandmark({0, 9}); }, "no landmark");
  expectRefused(
      [&](Batch& batch) {
        batch.removeFactor(seen_a_);
        batch.removeVariable(variableOf(a_));
      },
      "belongs to landmark");
  expectRefused(
      [&](Batch& batch) {
        batch.addEvidence(b_);
        batch.mergeLandmarks(b_, a_);
      },
      "evidence");
  applied([&](Batch& batch) { batch.mergeLandmarks(b_, a_); });
  expectRefused([&](Batch& batch) { batch.addEvidence(b_); }, "was merged");
}

TEST_F(BatchLandmarks, ABatchOfAnOldStateSaysWhyItIsUnfit) {
  Batch batch;
  batch.addFactor(measurement(pose_, variableOf(b_), b_));
  EXPECT_EQ(whyUnfit(batch, graph_, map_), "");
  applied([&](Batch& other) { other.mergeLandmarks(b_, a_); });
  EXPECT_NE(whyUnfit(batch, graph_, map_), "");
}

}  // namespace
}  // namespace omnimapper::mapper::batch_landmarks_test
