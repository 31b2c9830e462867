#include <gtest/gtest.h>
#include <omnimapper/graph/Consistency.h>

#include "Worlds.h"

namespace omnimapper::graph {
namespace {

using base::FactorId;
using base::VariableId;

/// A walk of `poses` steps of 1 m around a circle, from truth with the given noise of each step, and closures between
/// any two poses of it.
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
  /// A hypothesis that is wrong by `error`.
  FactorId closure(int a, int b, const Se2& error = {}) { return add(a, b, error, {0.02, 0.02, 0.01}, true); }
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

TEST(ConsistencyTest, AGrossFalseClosureOfARingIsRefusedAndTheTrueOnesAct) {
  Ring ring(60);
  const FactorId good = ring.closure(0, 59), other = ring.closure(1, 58), bad = ring.closure(5, 40);
  const FactorId false_one = ring.closure(10, 55, {4, 3, 1});
  const std::vector<Verdict> verdicts = testConsistency(ring.graph(), {good, other, bad, false_one});
  ASSERT_EQ(verdicts.size(), 4u);
  EXPECT_TRUE(ring.accepted(good) && ring.accepted(other) && ring.accepted(bad));
  EXPECT_FALSE(ring.accepted(false_one));
  EXPECT_EQ(verdicts[3].factor, false_one);
  EXPECT_FALSE(verdicts[3].changed);
  EXPECT_GT(verdicts[3].chi2, 16.3);
  EXPECT_EQ(verdicts[3].degrees_of_freedom, 3);
  EXPECT_NE(verdicts[3].reason.find("does not fit the map"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::graph
