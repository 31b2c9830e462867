#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "DepthRooms.h"

namespace omnimapper::perception::normals_test {
namespace {

const camera::Pinhole kCamera{100, 100, 39.5, 31.5};
constexpr int kWidth = 80, kHeight = 64;

template <class Depth>
NormalImage normalsOf(const Depth& depth, NormalOptions options = {}) {
  std::vector<float> image;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) image.push_back(static_cast<float>(depth(x, y)));
  }
  return NormalEstimator(options).estimate(camera::DepthImage(image.data(), kWidth, kHeight, kCamera));
}

TEST(Normals, OfAWallStraightAheadPointBackAtTheSensor) {
  const auto normals = normalsOf([](int, int) { return 1.5; });
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals.z()[i], -1, 1e-6) << i;
    EXPECT_NEAR(normals.x()[i], 0, 1e-6) << i;
  }
}

TEST(Normals, OfATiltedPlaneAreThatOfThePlaneWhateverTheRadius) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.6, -0.5).normalized();
  for (int radius = 1; radius <= 7; ++radius) {
    NormalOptions options;
    options.radius = radius;
    const auto normals = normalsOf(
        [&](int x, int y) { return -1 / n.dot(Eigen::Vector3d((x - 39.5) / 100, (y - 31.5) / 100, 1)); }, options);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Eigen::Vector3d found(normals.x()[i], normals.y()[i], normals.z()[i]);
      ASSERT_LT((found - n).norm(), 0.08 / (radius * radius)) << "radius " << radius << " pixel " << i;
      ASSERT_NEAR(found.norm(), 1, 1e-5);
    }
  }
}

TEST(Normals, StopAtEdges) {
  // A wall at 1 m in front of a tilted one at 2 m.
  const auto depth = [](int x, int) { return x < 40 ? 1. : 2 / (1 + (x - 39.5) / 200.); };
  const auto normals = normalsOf(depth);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      // n ~ -(a, 0, c) where 1/z = a (x - cx) / f + c.
      const Eigen::Vector2d expected = x < 40 ? Eigen::Vector2d(0, -1) : Eigen::Vector2d(-0.25, -0.5).normalized();
      EXPECT_LT((Eigen::Vector2d(normals.x()[i], normals.z()[i]) - expected).norm(), 0.01) << x << " " << y;
    }
  }
}

TEST(Normals, AreMissingWhereNothingWasMeasured) {
  const auto normals = normalsOf([](int x, int y) { return x > 20 && x < 30 && y > 20 ? 0 : 1; });
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(std::isnan(normals.z()[static_cast<std::size_t>(y * kWidth + x)]), x > 20 && x < 30 && y > 20);
    }
  }
}

TEST(Normals, SmallImagesHaveNoneOrAFew) {
  const std::vector<float> ones(100, 1.F);
  for (const int width : {0, 1, 9, 10}) {
    const auto normals = NormalEstimator({}).estimate(camera::DepthImage(ones.data(), width, 10, kCamera));
    EXPECT_EQ(normals.size(), static_cast<std::size_t>(width * 10));
  }
}

TEST(Normals, OfNoisyRoomsAreRightToAFewDegrees) {
  std::vector<double> degrees;
  double pixels = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    testing::Dice dice(seed);
    const rooms::Scene scene = rooms::randomRoom(dice);
    const auto view = rooms::render(scene);
    const auto depth = rooms::withNoise(view, scene.width, scene.height, camera::DepthNoise(), dice);
    NormalOptions options;
    options.radius = 7;
    const auto normals = NormalEstimator(options).estimate(camera::DepthImage(depth.data(), 640, 480, scene.camera));
    for (std::size_t i = 0; i < depth.size(); ++i) {
      if (view.face[i] == 0 || view.depth[i] > 2.5) continue;
      ++pixels;
      if (std::isnan(normals.z()[i])) continue;
      const rooms::Face& face = scene.faces[view.face[i] - 1U];
      const double cosine = std::abs(face.half_a.cross(face.half_b)
                                         .normalized()
                                         .dot(Eigen::Vector3d(normals.x()[i], normals.y()[i], normals.z()[i])));
      degrees.push_back(std::acos(std::min(1.0, cosine)) * 57.2957795);
    }
  }
  EXPECT_GT(static_cast<double>(degrees.size()), 0.97 * pixels);
  std::sort(degrees.begin(), degrees.end());
  EXPECT_LT(degrees[degrees.size() / 2], 4);
  EXPECT_LT(degrees[degrees.size() * 9 / 10], 11);
}

TEST(OrganizedPoints, AreOnTheRaysOfTheirPixels) {
  const std::vector<std::uint16_t> units{1000, 0, 65535, 2000};
  const auto points = backProject(camera::DepthImage(units.data(), 1e-3, 2, 2, camera::Pinhole{100, 50, 0.5, 0.5}));
  EXPECT_FLOAT_EQ(points.x[0], -0.005F);
  EXPECT_FLOAT_EQ(points.y[0], -0.01F);
  EXPECT_FLOAT_EQ(points.z[0], 1);
  EXPECT_TRUE(std::isnan(points.z[1]) && std::isnan(points.x[2]));
  EXPECT_FLOAT_EQ(points.x[3], 0.01F);
  EXPECT_FLOAT_EQ(points.z[3], 2);
}

TEST(NormalEstimator, OptionsThatMakeNoSenseAreRefused) {
  const auto refuses = [](const NormalOptions& options) {
    try {
      NormalEstimator{options};
      return false;
    } catch (const base::Error& error) {
      return error.code() == base::ExitCode::out_of_range;
    }
  };
  EXPECT_FALSE(refuses({}));
  for (const int radius : {0, 8}) {
    NormalOptions options;
    options.radius = radius;
    EXPECT_TRUE(refuses(options)) << radius;
  }
  NormalOptions options;
  options.min_depth = 0;
  EXPECT_TRUE(refuses(options)) << "it is a divisor";
  options = {};
  options.noise_at_1m = -1;
  EXPECT_TRUE(refuses(options));
}

}  // namespace
}  // namespace omnimapper::perception::normals_test
