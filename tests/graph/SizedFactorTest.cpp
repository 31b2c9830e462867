#include <gtest/gtest.h>

#include <vector>

#include "omnimapper/graph/SizedFactor.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph::sized_factor_test {
namespace {

// Twice the x of a point, and the sum of all of a pose.
class Example : public SizedFactor<2, Point2Kind, Se2Kind> {
 public:
  std::string_view kind() const override { return "example"; }
  void evaluate(const double* const* values, double* residual, double* const* jacobians) const override {
    residual[0] = 2 * values[0][0];
    residual[1] = values[1][0] + values[1][1] + values[1][2];
    if (auto by_point = jacobian<0>(jacobians)) by_point << 2, 0, 0, 0;
    if (auto by_pose = jacobian<1>(jacobians)) {
      by_pose.setZero();
      by_pose.row(1).setOnes();
    }
  }
  void write(std::ostream&) const override {}
};

TEST(SizedFactor, SizesAndKindsFollowFromTheTypes) {
  const Example factor;
  EXPECT_EQ(factor.residualSize(), 2);
  EXPECT_EQ(factor.variableKinds(), (std::vector<std::string_view>{"point2", "se2"}));
}

TEST(SizedFactor, JacobiansAreRowMajorAndOnlyThoseThatAreAskedForAreWritten) {
  const Example factor;
  const double point[2] = {3, 4}, pose[3] = {1, 2, 0.5};
  const double* const values[2] = {point, pose};
  double residual[2], by_point[4] = {9, 9, 9, 9}, by_pose[6] = {9, 9, 9, 9, 9, 9};
  factor.evaluate(values, residual, nullptr);
  EXPECT_EQ(residual[0], 6);
  EXPECT_EQ(residual[1], 3.5);
  double* none_of_point[2] = {nullptr, by_pose};
  factor.evaluate(values, residual, none_of_point);
  EXPECT_EQ(std::vector<double>(by_pose, by_pose + 6), (std::vector<double>{0, 0, 0, 1, 1, 1}));
  double* none_of_pose[2] = {by_point, nullptr};
  factor.evaluate(values, residual, none_of_pose);
  EXPECT_EQ(std::vector<double>(by_point, by_point + 4), (std::vector<double>{2, 0, 0, 0}));
}

TEST(SizedFactor, KindsAsTypesAgreeWithTheVariables) {
  const auto expect_same = [](auto kind, const Variable& variable) {
    EXPECT_EQ(decltype(kind)::kName, variable.kind());
    EXPECT_EQ(+decltype(kind)::kTangentSize, variable.tangentSize());
  };
  expect_same(Se2Kind(), *se2());
  expect_same(Se3Kind(), *se3());
  expect_same(Point2Kind(), *point2());
  expect_same(Point3Kind(), *point3());
}

}  // namespace
}  // namespace omnimapper::graph::sized_factor_test
