#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include "Residuals.h"

namespace omnimapper::calibration::residuals_test {
namespace {

const Intrinsics kLens{500, 510, 320, 240, 0.1, -0.2, 0.001, -0.002, 0.05};

TEST(Projection, IsThePinholesWithoutALens) {
  const Intrinsics camera{500, 510, 320, 240};
  const Eigen::Vector2d place = project(camera.data(), Eigen::Vector3d(0.4, -0.2, 2));
  EXPECT_NEAR(place.x(), 420, 1e-12);
  EXPECT_NEAR(place.y(), 189, 1e-12);
}

TEST(Projection, DistortsAsInBrownsModel) {
  // x = 0.2, y = 0.1, r2 = 0.05: radial 1 + 0.005 - 0.0005 + 0.00000625.
  const Eigen::Vector2d place = project(kLens.data(), Eigen::Vector3d(0.2, 0.1, 1));
  const double radial = 1.00450625;
  EXPECT_NEAR(place.x(), 320 + 500 * (0.2 * radial + 2 * 0.001 * 0.02 - 0.002 * (0.05 + 2 * 0.04)), 1e-9);
  EXPECT_NEAR(place.y(), 240 + 510 * (0.1 * radial + 0.001 * (0.05 + 2 * 0.01) - 2 * 0.002 * 0.02), 1e-9);
}

TEST(Projection, RayThroughAPixelIsItsInverse) {
  for (const double u : {10.0, 320.0, 620.0}) {
    for (const double v : {10.0, 240.0, 470.0}) {
      const Eigen::Vector2d back = project(kLens.data(), rayThrough(kLens, {u, v}));
      EXPECT_NEAR(back.x(), u, 1e-6);
      EXPECT_NEAR(back.y(), v, 1e-6);
    }
  }
}

TEST(PixelResidual, IsTheMissInStandardDeviations) {
  const PixelResidual residual{{421, 187}, 0.5};
  const MotionBlock still{};
  const double point[3] = {0.4, -0.2, 2}, timing[3] = {0, 0, 0};
  const Intrinsics camera{500, 510, 320, 240};
  double r[2];
  ASSERT_TRUE(residual(still.data(), point, camera.data(), timing, r));
  EXPECT_NEAR(r[0], -2, 1e-12);
  EXPECT_NEAR(r[1], 4, 1e-12);
  const double behind[3] = {0, 0, -1};
  EXPECT_FALSE(residual(still.data(), behind, camera.data(), timing, r));
}

TEST(PixelResidual, ARowThatIsTakenLaterSeesTheCameraFartherOn) {
  PixelResidual residual{{320, 240}, 1};
  residual.row_share = 0.5;
  residual.velocity << 1, 0, 0, 0, 0, 0;  // m/s to the right
  const MotionBlock still{};
  const double point[3] = {0, 0, 2}, timing[3] = {0.02, 0, 0};
  const Intrinsics camera{500, 500, 320, 240};
  double r[2];
  ASSERT_TRUE(residual(still.data(), point, camera.data(), timing, r));
  EXPECT_NEAR(r[0], -500 * 0.01 / 2, 1e-12) << "10 ms later the camera is 1 cm on";
}

TEST(DepthResidual, IsTheMissInInverseDepthOverTheSlopeOfTheSurface) {
  // The point is seen 10 px to the right of the pixel where the plane has 0.5/m, with a slope of 0.001/m/px; its depth
  // is 1.9 m.
  const LocalPlane plane{{310, 240}, 0.5, {0.001, 0}, 0.01};
  const DepthResidual residual{plane};
  const MotionBlock still{};
  const double point[3] = {0, 0, 1.9}, scale = 1.02, timing[3] = {0, 0, 0};
  const Intrinsics camera{500, 500, 320, 240};
  double r = 0;
  ASSERT_TRUE(residual(still.data(), point, still.data(), camera.data(), &scale, timing, &r));
  EXPECT_NEAR(r, (0.51 - 1.02 / 1.9) / 0.01, 1e-12);
}

TEST(DistanceResidual, IsOfTheBaseAndNotOfTheCamera) {
  // A camera 0.5 m in front of the base makes a quarter turn about the base, which does not move.
  const DistanceResidual residual{{0, 0, -0.5}, {0, 0, -0.5}, 0.3, 0.1};
  const MotionBlock first{0, 0, 0, 0, 0, -0.5};  // camera_from_world with the base in the world's origin
  const MotionBlock second{0, 1.5707963267948966, 0, 0, 0, -0.5};
  double r = 0;
  ASSERT_TRUE(residual(first.data(), second.data(), &r));
  EXPECT_NEAR(r, -3, 1e-4);
}

// A separate class, because otherwise the library would use the cost functions of this program, which is not optimized.
template <class Residual>
struct Tested {
  Residual residual;
  template <class... Arguments>
  bool operator()(Arguments... arguments) const {
    return residual(arguments...);
  }
};

// Checks that derivatives by dual numbers agree with finite differences.
template <class Cost>
void expectDerivatives(const Cost& cost, const std::vector<std::vector<double>>& blocks, int rows) {
  const auto evaluate = [&](const std::vector<std::vector<double>>& at, std::vector<std::vector<double>>* jacobians) {
    std::vector<double> r(static_cast<std::size_t>(rows));
    std::vector<const double*> pointers;
    std::vector<double*> into;
    for (std::size_t i = 0; i < at.size(); ++i) {
      pointers.push_back(at[i].data());
      if (jacobians) {
        jacobians->emplace_back(static_cast<std::size_t>(rows) * at[i].size());
      }
    }
    if (jacobians)
      for (auto& one : *jacobians) into.push_back(one.data());
    EXPECT_TRUE(cost.Evaluate(pointers.data(), r.data(), jacobians ? into.data() : nullptr));
    return r;
  };
  std::vector<std::vector<double>> jacobians;
  evaluate(blocks, &jacobians);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t i = 0; i < blocks[b].size(); ++i) {
      constexpr double kStep = 1e-6;
      auto more = blocks, less = blocks;
      more[b][i] += kStep;
      less[b][i] -= kStep;
      const auto up = evaluate(more, nullptr), down = evaluate(less, nullptr);
      for (int row = 0; row < rows; ++row) {
        const auto at = static_cast<std::size_t>(row);
        const double expected = (up[at] - down[at]) / (2 * kStep);
        EXPECT_NEAR(jacobians[b][at * blocks[b].size() + i], expected, 1e-4 * (1 + std::abs(expected)))
            << "block " << b << " number " << i;
      }
    }
  }
}

const std::vector<double> kMotion{0.2, -0.3, 0.1, 0.1, -0.2, 0.3}, kPoint{0.4, 0.3, 2.5}, kTiming{0.025, 0.02, -0.006};
const std::vector<double> kCamera(kLens.begin(), kLens.end());

TEST(PixelResidual, DerivativesAgreeWithDifferences) {
  PixelResidual residual{{300, 200}, 0.5, 0.3};
  residual.velocity << 0.2, -0.1, 0.3, 0.5, -0.4, 0.2;
  expectDerivatives(
      ceres::AutoDiffCostFunction<Tested<PixelResidual>, 2, 6, 3, 9, 3>(new Tested<PixelResidual>{residual}),
      {kMotion, kPoint, kCamera, kTiming}, 2);
}

TEST(DepthResidual, DerivativesAgreeWithDifferences) {
  DepthResidual residual{{{310, 240}, 0.4, {0.001, -0.0005}, 0.01}, -0.2};
  residual.velocity << 0.2, -0.1, 0.3, 0.5, -0.4, 0.2;
  expectDerivatives(
      ceres::AutoDiffCostFunction<Tested<DepthResidual>, 1, 6, 3, 6, 9, 1, 3>(new Tested<DepthResidual>{residual}),
      {kMotion, kPoint, {0.01, 0.02, -0.01, 0.02, 0.01, 0}, kCamera, {1.02}, kTiming}, 1);
}

TEST(DistanceResidual, DerivativesAgreeWithDifferences) {
  const DistanceResidual residual{{0.1, 0.2, -0.3}, {0.1, 0.2, -0.3}, 0.3, 0.01};
  expectDerivatives(
      ceres::AutoDiffCostFunction<Tested<DistanceResidual>, 1, 6, 6>(new Tested<DistanceResidual>{residual}),
      {kMotion, {0.1, -0.2, 0.3, -0.4, 0.2, 0.1}}, 1);
}

}  // namespace
}  // namespace omnimapper::calibration::residuals_test
