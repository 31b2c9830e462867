#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/Consistency.h>
#include <omnimapper/graph/Initialization.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>

#include "Worlds.h"

namespace omnimapper::graph::consistency_test {
namespace {

using base::FactorId;
using base::VariableId;

/// A path of `poses` steps of 1 m around a circle, with the given noise of each step, and closures between any two of
/// its poses.
class Ring {
 public:
  explicit Ring(int poses, unsigned seed = 1) : noise_(seed) {
    const double step = 2 * geometry::kPi / poses;
    Se2 pose;
    for (int i = 0; i < poses; ++i) {
      truth_.push_back(pose);
      ids_.push_back(graph_.addVariable(se2(), toValue(i == 0 ? pose : Se2()), i == 0));
      if (i > 0) {
        const FactorId edge = add(i - 1, i, Se2(), {0.02, 0.02, 0.01}, false);
        const auto& measured = dynamic_cast<const BetweenSe2&>(*graph_.factor(edge).factor).measured();
        graph_.setValue(ids_[i], toValue(se2FromValue(graph_.value(ids_[i - 1]).data()) * measured));
      }
      pose = pose * Se2{1, 0, step};
    }
  }
  Graph& graph() { return graph_; }
  const std::vector<VariableId>& ids() const { return ids_; }
  const std::vector<Se2>& truth() const { return truth_; }
  /// A hypothesis that is wrong by `error`.
  FactorId closure(int a, int b, const Se2& error = {}) { return add(a, b, error, {0.02, 0.02, 0.01}, true); }
  std::vector<HypothesisVerdict> test(const std::vector<FactorId>& fresh, ConsistencyOptions::Method method) {
    ConsistencyOptions options;
    options.method = method;
    return testConsistency(graph_, fresh, options);
  }
  double largestError() const {
    double error = 0;
    for (std::size_t i = 0; i < ids_.size(); ++i)
      error = std::max(error, (graph_.value(ids_[i]).head<2>() - truth_[i].translation()).norm());
    return error;
  }
  bool accepted(FactorId id) const { return graph_.factor(id).weight > 0; }

 private:
  FactorId add(int a, int b, const Se2& error, const Eigen::Vector3d& sigmas, bool hypothesis) {
    FactorRecord record{
        {ids_[a], ids_[b]},
        std::make_shared<BetweenSe2>(plus(inverse(truth_[a]) * truth_[b], noise_.normals(sigmas)) * error),
        SquareRootInformation::fromSigmas(sigmas)};
    record.tags.hypothesis = hypothesis;
    record.weight = hypothesis ? 0 : 1;
    return graph_.addFactor(record);
  }

  Noise noise_;
  std::vector<Se2> truth_;
  std::vector<VariableId> ids_;
  Graph graph_;
};

using Method = ConsistencyOptions::Method;

/// Properties that every method that tests must have.
class ConsistencyMethodTest : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, ConsistencyMethodTest, ::testing::Values(Method::pairwise, Method::graduated));

TEST_P(ConsistencyMethodTest, AGrossFalseClosureIsRefusedAndTheTrueOnesAct) {
  Ring ring(60);
  const FactorId one = ring.closure(0, 59), two = ring.closure(1, 58), three = ring.closure(5, 40);
  const FactorId false_one = ring.closure(10, 55, {4, 3, 1});
  const std::vector<HypothesisVerdict> verdicts = ring.test({one, two, false_one, three}, GetParam());
  ASSERT_EQ(verdicts.size(), 4u);
  EXPECT_TRUE(ring.accepted(one) && ring.accepted(two) && ring.accepted(three));
  EXPECT_FALSE(ring.accepted(false_one));
  EXPECT_EQ(verdicts[2].factor, false_one);
  EXPECT_FALSE(verdicts[2].changed);
  EXPECT_TRUE(verdicts[0].changed);
  EXPECT_GT(verdicts[2].chi2, 16.27);  // of three degrees of freedom, at 0.999
  EXPECT_EQ(verdicts[2].degrees_of_freedom, 3);
  EXPECT_EQ(verdicts[2].reason.find("contradicts"), 0u) << verdicts[2].reason;
  EXPECT_LT(ring.largestError(), 0.3);
}

TEST_P(ConsistencyMethodTest, WithoutFalseOnesTheResultIsTheSolutionOfAll) {
  Ring ring(60), all(60);
  std::vector<FactorId> fresh;
  for (int i = 0; i < 5; ++i) {
    fresh.push_back(ring.closure(i, 59 - i));
    all.graph().setWeight(all.closure(i, 59 - i), 1);
  }
  for (const HypothesisVerdict& verdict : ring.test(fresh, GetParam())) EXPECT_TRUE(verdict.accepted) << verdict.reason;
  const SolveSummary expected = solve(all.graph());
  int asked = 0;
  SolveOptions counting;
  counting.stop = [&asked] { return ++asked, false; };
  for (const VariableId id : ring.ids()) EXPECT_NEAR((ring.graph().value(id) - all.graph().value(id)).norm(), 0, 1e-6);
  Ring again(60);
  for (int i = 0; i < 5; ++i) again.closure(i, 59 - i);
  ConsistencyOptions options;
  options.method = GetParam();
  testConsistency(again.graph(), fresh, options, counting);
  EXPECT_LE(asked, expected.iterations);  // one solution and no more; the last iteration may end before it calls stop()
}

// An error of 4.02 standard deviations, within the gate of 4.03: there the loss leaves hardly any weight, and a closure
// that was accepted would be taken back because of the error that it should correct.
TEST_P(ConsistencyMethodTest, WhatIsBelievedFromAfarHoldsThoughItsLossIsRobust) {
  Graph graph;
  const VariableId begin = graph.addVariable(se2(), toValue(Se2()), true),
                   end = graph.addVariable(se2(), toValue(Se2()));
  const auto add = [&](const Se2& measured, const Eigen::Vector3d& sigmas, bool hypothesis) {
    FactorRecord record{
        {begin, end}, std::make_shared<BetweenSe2>(measured), SquareRootInformation::fromSigmas(sigmas)};
    record.tags.hypothesis = hypothesis;
    record.weight = hypothesis ? 0 : 1;
    if (hypothesis) record.loss = Loss::cauchy(2);
    return graph.addFactor(record);
  };
  add(Se2(), {1, 1, 0.1}, false);
  const Eigen::Vector3d sharp(0.01, 0.01, 0.01);
  const std::vector<FactorId> closures{add({4.02, 0, 0}, sharp, true)};
  ConsistencyOptions options;
  options.method = GetParam();
  options.min_likelihood_ratio = 1e-9;  // so low that a single closure need not wait for others
  testConsistency(graph, closures, options);
  for (const FactorId id : closures) {
    EXPECT_EQ(graph.factor(id).weight, 1);
    EXPECT_EQ(graph.factor(id).loss.kind(), Loss::Kind::cauchy);
  }
  EXPECT_NEAR(graph.value(end)[0], 4.02, 0.01);
}

TEST_P(ConsistencyMethodTest, AnEarlyFalseOneIsTakenBackWhenTwoThatAgreeContradictIt) {
  Ring ring(60);
  const FactorId early = ring.closure(2, 50, {0.6, -0.5, 0.1});
  ring.graph().setWeight(early, 1);  // accepted when little was known
  solve(ring.graph());
  const FactorId first = ring.closure(0, 59);
  ring.test({first}, GetParam());
  EXPECT_TRUE(ring.accepted(early));
  EXPECT_FALSE(ring.accepted(first));
  const FactorId second = ring.closure(1, 58);
  const std::vector<HypothesisVerdict> verdicts = ring.test({second}, GetParam());
  EXPECT_TRUE(ring.accepted(first));
  EXPECT_TRUE(ring.accepted(second));
  EXPECT_FALSE(ring.accepted(early));
  ASSERT_EQ(verdicts.size(), 3u);
  EXPECT_EQ(verdicts[0].factor, second);
  EXPECT_EQ(verdicts[1].factor, early);
  EXPECT_EQ(verdicts[1].reason.find("taken back"), 0u) << verdicts[1].reason;
  EXPECT_TRUE(verdicts[1].against.has_value());
  EXPECT_EQ(verdicts[2].factor, first);
  EXPECT_LT(ring.largestError(), 0.3);
}

TEST_P(ConsistencyMethodTest, AGroupOfFalseOnesThatAgreeIsRefusedWhereTheMapIsKnown) {
  Ring ring(60);
  ring.test({ring.closure(0, 59), ring.closure(1, 58), ring.closure(15, 45), ring.closure(30, 55)}, GetParam());
  std::vector<FactorId> group;
  for (int i = 0; i < 4; ++i) {
    // The same shift of the far end in the frame of the near one, by closures of different pairs.
    const Se2 a_from_b = inverse(ring.truth()[10 + i]) * ring.truth()[10] * Se2{3, 2, 0.5} * inverse(ring.truth()[40]) *
                         ring.truth()[40 + i];
    group.push_back(
        ring.closure(10 + i, 40 + i, inverse(inverse(ring.truth()[10 + i]) * ring.truth()[40 + i]) * a_from_b));
  }
  for (const FactorId id : group) ring.test({id}, GetParam());
  for (const FactorId id : group) EXPECT_FALSE(ring.accepted(id));
  EXPECT_LT(ring.largestError(), 0.3);
}

TEST_P(ConsistencyMethodTest, WhatCouldFitByChanceWaitsForAnotherToBearItOut) {
  Ring ring(300);
  const FactorId first = ring.closure(0, 299);
  std::vector<HypothesisVerdict> verdicts = ring.test({first}, GetParam());
  EXPECT_FALSE(ring.accepted(first));
  EXPECT_EQ(verdicts[0].reason.find("waits"), 0u) << verdicts[0].reason;
  const FactorId second = ring.closure(1, 298);
  verdicts = ring.test({second}, GetParam());
  EXPECT_TRUE(ring.accepted(first));
  EXPECT_TRUE(ring.accepted(second));
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[1].factor, first);
  EXPECT_TRUE(verdicts[1].changed);
}

TEST_P(ConsistencyMethodTest, ARefusedOneComesBackWhenTheMapHasMovedToIt) {
  Ring ring(60);
  const FactorId closure = ring.closure(0, 59);
  const FactorId wrong = ring.closure(1, 57, {0.6, -0.5, 0.1});
  ring.graph().setWeight(wrong, 1);
  solve(ring.graph());
  ring.test({closure}, GetParam());
  EXPECT_FALSE(ring.accepted(closure));
  ring.graph().removeFactor(wrong);
  ring.test({ring.closure(0, 58)}, GetParam());
  EXPECT_TRUE(ring.accepted(closure));
}

TEST_P(ConsistencyMethodTest, TheSameGraphGivesTheSameVerdictsInEveryBit) {
  const auto run = [] {
    Ring ring(80);
    std::vector<FactorId> fresh;
    for (int i = 0; i < 6; ++i) fresh.push_back(ring.closure(i, 79 - i, i % 2 ? Se2{1.0 * i, 1, 0.3} : Se2{}));
    const std::vector<HypothesisVerdict> verdicts = ring.test(fresh, GetParam());
    std::vector<double> numbers;
    for (const HypothesisVerdict& verdict : verdicts) numbers.push_back(verdict.chi2);
    for (const VariableId id : ring.ids())
      for (const double number : ring.graph().value(id)) numbers.push_back(number);
    return numbers;
  };
  EXPECT_EQ(run(), run());
}

TEST_P(ConsistencyMethodTest, APriorOrAPointIsTestedToo) {
  Ring ring(30);
  const auto add = [&](std::vector<VariableId> variables, std::shared_ptr<const Factor> factor, int rows) {
    FactorRecord record{std::move(variables), std::move(factor),
                        SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(rows, 0.05))};
    record.tags.hypothesis = true;
    record.weight = 0;
    return ring.graph().addFactor(record);
  };
  const Se2 there = ring.truth()[29];
  const FactorId good = add({ring.ids()[29]}, std::make_shared<PriorSe2>(there), 3);
  const FactorId bad = add({ring.ids()[29]}, std::make_shared<PriorSe2>(there * Se2{3, 0, 0}), 3);
  const VariableId point = ring.graph().addVariable(point2(), Eigen::Vector2d(1, 1));
  ring.graph().addFactor({{ring.ids()[0], point},
                          std::make_shared<PointFactor2>(Eigen::Vector2d(1, 1)),
                          SquareRootInformation::fromSigmas(Eigen::Vector2d(0.05, 0.05))});
  const FactorId seen =
      add({ring.ids()[29], point}, std::make_shared<PointFactor2>(inverse(there) * Eigen::Vector2d(1, 1)), 2);
  const FactorId mistaken =
      add({ring.ids()[29], point}, std::make_shared<PointFactor2>(inverse(there) * Eigen::Vector2d(4, 1)), 2);
  ring.test({good, bad, seen, mistaken}, GetParam());
  EXPECT_TRUE(ring.accepted(good));
  EXPECT_FALSE(ring.accepted(bad));
  EXPECT_TRUE(ring.accepted(seen));
  EXPECT_FALSE(ring.accepted(mistaken));
}

TEST_P(ConsistencyMethodTest, TheFirstOfAnUnconstrainedVariableActsUntilAMajorityContradictsIt) {
  Ring ring(30);
  const VariableId point = ring.graph().addVariable(point2(), Eigen::Vector2d(0, 0));
  const Eigen::Vector2d in_map(2, 2), elsewhere(9, -4);
  const auto seen = [&](int from, const Eigen::Vector2d& where) {
    FactorRecord record{{ring.ids()[from], point},
                        std::make_shared<PointFactor2>(inverse(ring.truth()[from]) * where),
                        SquareRootInformation::fromSigmas(Eigen::Vector2d(0.05, 0.05))};
    record.tags.hypothesis = true;
    record.weight = 0;
    return ring.graph().addFactor(record);
  };
  const FactorId mistaken = seen(0, elsewhere);
  EXPECT_TRUE(ring.test({mistaken}, GetParam())[0].accepted);
  EXPECT_NEAR((ring.graph().value(point) - elsewhere).norm(), 0, 1e-6);
  std::vector<FactorId> good;
  for (int from = 1; from < 4; ++from) {
    good.push_back(seen(from, in_map));
    ring.test({good.back()}, GetParam());
  }
  EXPECT_FALSE(ring.accepted(mistaken));
  for (const FactorId id : good) EXPECT_TRUE(ring.accepted(id));
  EXPECT_NEAR((ring.graph().value(point) - in_map).norm(), 0, 0.2);
}

TEST_P(ConsistencyMethodTest, ManyAtOnceAreJudgedAsIfOneAfterAnother) {
  World2 world = gridWorld(400, 3, {0.02, 0.02, 0.005});
  std::vector<FactorId> fresh;
  std::vector<bool> truth;
  Noise noise(4);
  std::vector<std::pair<FactorId, FactorRecord>> closures;
  for (const auto& [id, record] : world.graph.factors())
    if (record.variables[1].index != record.variables[0].index + 1) closures.emplace_back(id, record);
  ASSERT_GT(closures.size(), 90u);
  for (auto& [id, record] : closures) {
    world.graph.removeFactor(id);
    record.tags.hypothesis = true;
    fresh.push_back(world.graph.addFactor(record));
    truth.push_back(true);
    if (noise.below(2) == 0) {
      const int a = noise.below(400);
      record.variables = {world.ids[a], world.ids[(a + 20 + noise.below(300)) % 400]};
      record.factor = std::make_shared<BetweenSe2>(Se2{noise.normal(0.3), noise.normal(0.3), noise.normal(0.2)});
      fresh.push_back(world.graph.addFactor(record));
      truth.push_back(false);
    }
  }
  initializeByChaining(world.graph);
  ConsistencyOptions options;
  options.method = GetParam();
  const std::vector<HypothesisVerdict> verdicts = testConsistency(world.graph, fresh, options);
  ASSERT_EQ(verdicts.size(), fresh.size());
  int refused = 0, let_in = 0;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    EXPECT_EQ(verdicts[i].factor, fresh[i]);
    EXPECT_EQ(verdicts[i].accepted, world.graph.factor(fresh[i]).weight > 0);
    refused += truth[i] && !verdicts[i].accepted;
    let_in += !truth[i] && verdicts[i].accepted;
  }
  EXPECT_LE(refused, static_cast<int>(closures.size()) / 50);
  EXPECT_LE(let_in, 1);
  double error = 0;
  for (std::size_t i = 0; i < world.ids.size(); ++i)
    error = std::max(error, (world.graph.value(world.ids[i]).head<2>() - world.truth[i].translation()).norm());
  EXPECT_LT(error, 0.3);
}

// At the end of a long path, the heading error is so large that one sign predicts, to first order, the wrong place of
// the next.
TEST(ConsistencyTest, PointsAtTheEndOfALongPathConfirmOneAnother) {
  Ring ring(2400, 8);
  const auto pointSeenFrom = [&](int pose, const Eigen::Vector2d& in_map) {
    const Eigen::Vector2d in_base = inverse(ring.truth()[pose]) * in_map;
    const Se2 estimate = se2FromValue(ring.graph().value(ring.ids()[pose]).data());
    const Eigen::Vector2d guess = estimate * in_base;
    const auto point = ring.graph().addVariable(point3(), Eigen::Vector3d(guess.x(), guess.y(), 1.5));
    ring.graph().addFactor({{ring.ids()[pose], point},
                            std::make_shared<PointFactor3>(Eigen::Vector3d(in_base.x(), in_base.y(), 1.5)),
                            SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(0.03))});
    return point;
  };
  const auto one = [&](VariableId a, VariableId b) {
    FactorRecord record{{a, b},
                        std::make_shared<SamePointFactor>(0.01),
                        SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(0.03))};
    record.tags.hypothesis = true;
    record.weight = 0;
    return ring.graph().addFactor(record);
  };
  std::vector<FactorId> closures;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d place = ring.truth()[3 * i + 1] * Eigen::Vector2d(1, i % 2 == 0 ? 1.5 : -1.5);
    closures.push_back(one(pointSeenFrom(3 * i, place), pointSeenFrom(2390 + 3 * i, place)));
  }
  const FactorId false_one =
      one(pointSeenFrom(600, ring.truth()[601].translation()), pointSeenFrom(1800, ring.truth()[1801].translation()));
  EXPECT_GT(ring.largestError(), 20);
  ring.test({false_one}, Method::pairwise);
  std::string reasons;
  for (const FactorId id : closures) {
    for (const auto& verdict : ring.test({id}, Method::pairwise))
      reasons += toString(verdict.factor) + " " + verdict.reason + " " + std::to_string(verdict.chi2) + "\n";
  }
  for (const FactorId id : closures) EXPECT_TRUE(ring.accepted(id)) << toString(id) << "\n" << reasons;
  EXPECT_NE(reasons.find("confirmed by others"), std::string::npos) << reasons;
  EXPECT_FALSE(ring.accepted(false_one));
}

TEST(ConsistencyTest, MethodNoneLetsEveryHypothesisAct) {
  Ring ring(60);
  const FactorId false_one = ring.closure(10, 55, {4, 3, 1});
  EXPECT_TRUE(ring.test({false_one}, Method::none)[0].accepted);
  EXPECT_TRUE(ring.accepted(false_one));
}

TEST(ConsistencyTest, WhatIsNoHypothesisIsAnError) {
  Ring ring(10);
  const FactorId odometry = (*ring.graph().factors().begin()).first;
  EXPECT_THROW(testConsistency(ring.graph(), {odometry}), base::Error);
}

}  // namespace
}  // namespace omnimapper::graph::consistency_test
