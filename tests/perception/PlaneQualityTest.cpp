// Quality of the planes found in simulated rooms with a Kinect's noise.
#include <gtest/gtest.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "PlaneAgreement.h"

namespace omnimapper::perception::plane_quality_test {
namespace {

using rooms::Scene;
using rooms::View;

constexpr int kWidth = 640, kHeight = 480;

struct Shot {
  Scene scene;
  View truth;
  PlaneSegmentation found;
};

Shot shoot(std::uint64_t seed) {
  testing::Dice dice(seed);
  Shot shot;
  shot.scene = rooms::randomRoom(dice);
  shot.truth = rooms::render(shot.scene);
  const auto depth = rooms::withNoise(shot.truth, kWidth, kHeight, camera::DepthNoise(), dice);
  shot.found = PlaneSegmenter({}).segment(camera::DepthImage(depth.data(), kWidth, kHeight, shot.scene.camera));
  return shot;
}

/// Distance [px] of a corner of pixels to the nearest edge between faces, up to `reach`.
double distanceToEdge(const View& truth, const PixelCorner& corner, int reach) {
  const auto face = [&](int x, int y) {
    return x < 0 || y < 0 || x >= kWidth || y >= kHeight ? -1 : truth.face[static_cast<std::size_t>(y * kWidth + x)];
  };
  double nearest = reach;
  for (int y = corner.y - reach; y <= corner.y + reach; ++y) {
    for (int x = corner.x - reach; x <= corner.x + reach; ++x) {
      // The corner (x, y) is on an edge if the four pixels around it are not of one face.
      const int f = face(x, y);
      if (f == face(x - 1, y) && f == face(x, y - 1) && f == face(x - 1, y - 1)) continue;
      nearest = std::min(nearest, std::hypot(x - corner.x, y - corner.y));
    }
  }
  return nearest;
}

TEST(PlaneQuality, NineOfTenPlanesAreFoundToTheirBorders) {
  rooms::Agreement sum;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Shot shot = shoot(seed);
    sum += rooms::compare(shot.truth, shot.found.labels, kWidth, kHeight, 1500);
  }
  EXPECT_GE(sum.found, sum.true_planes * 8.0 / 9);
  EXPECT_GE(sum.reported_right, 0.88 * sum.reported);
  EXPECT_GE(sum.pixelsRight(), 0.97);
}

TEST(PlaneQuality, OutlinesAreWithinAPixelOfTheTruth) {
  double sum = 0, corners = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Shot shot = shoot(seed);
    for (const PlaneRegion& plane : shot.found.planes) {
      if (plane.inliers < 1500) continue;
      for (const PixelCorner& corner : plane.outline.corners) {
        sum += distanceToEdge(shot.truth, corner, 12);
        ++corners;
      }
    }
  }
  EXPECT_GT(corners, 1000);
  EXPECT_LT(sum / corners, 1.5);
}

TEST(PlaneQuality, NormalsAndDistancesAreRight) {
  std::vector<double> degrees, distances;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Shot shot = shoot(seed);
    for (std::size_t i = 0; i < shot.found.planes.size(); ++i) {
      std::vector<int> votes(shot.scene.faces.size() + 1, 0);
      for (std::size_t p = 0; p < shot.found.labels.size(); ++p) {
        if (shot.found.labels[p] == i + 1) ++votes[shot.truth.face[p]];
      }
      const auto most = std::max_element(votes.begin(), votes.end()) - votes.begin();
      ASSERT_GT(most, 0);
      const auto expected = rooms::planeOf(shot.scene.faces[static_cast<std::size_t>(most - 1)]);
      const auto& plane = shot.found.planes[i].plane_in_sensor;
      degrees.push_back(std::acos(std::min(1.0, plane.normal.dot(expected.normal))) * 57.2957795);
      distances.push_back(std::abs(plane.distance - expected.distance));
    }
  }
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  EXPECT_LT(median(degrees), 0.2);
  EXPECT_LT(median(distances), 0.005);
}

// A corner of a room: three planes, each smaller than the image.
Scene cornerOfARoom() {
  Scene scene;
  scene.width = 320;
  scene.height = 240;
  scene.camera = {262.5, 262.5, 159.5, 119.5};
  Eigen::Matrix3d edges;                                               // from the corner towards the camera
  edges << std::sqrt(2. / 3), -std::sqrt(1. / 6), -std::sqrt(1. / 6),  //
      0, std::sqrt(0.5), -std::sqrt(0.5),                              //
      -std::sqrt(1. / 3), -std::sqrt(1. / 3), -std::sqrt(1. / 3);
  edges = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 0.5).normalized()) * edges;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d a = 1.5 * edges.col((axis + 1) % 3), b = 1.5 * edges.col((axis + 2) % 3);
    scene.faces.push_back({Eigen::Vector3d(0.1, 0.1, 2.2) + a + b, a, b});
  }
  return scene;
}

/// Error other than noise that a sensor adds to the inverse depth 1/z [1/m] at a pixel.
using SharedError = std::function<double(double inverse_depth, const Eigen::Vector2d& ray)>;

View withError(View view, const Scene& scene, const SharedError& error) {
  const camera::Pinhole& c = scene.camera;
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    if (view.face[i] == 0) continue;
    const auto width = static_cast<std::size_t>(scene.width);
    const Eigen::Vector2d ray((static_cast<double>(i % width) - c.cx) / c.fx,
                              (static_cast<double>(i / width) - c.cy) / c.fy);
    const double inverse = 1 / static_cast<double>(view.depth[i]);
    view.depth[i] = static_cast<float>(1 / (inverse + error(inverse, ray)));
  }
  return view;
}

constexpr int kRenderings = 200;

/// Chi-square of each plane found in each of 200 noisy renderings of the corner, by its face. Other errors of the
/// sensor are drawn for each rendering.
std::vector<std::vector<double>> chi2OfRenderings(const PlaneOptions& options,
                                                  const std::function<SharedError(testing::Dice&)>& draw) {
  const Scene scene = cornerOfARoom();
  const View view = rooms::render(scene);
  std::vector<std::vector<double>> chi2(scene.faces.size());
  for (int seed = 0; seed < kRenderings; ++seed) {
    testing::Dice dice(static_cast<std::uint64_t>(1000 + seed));
    const View image = draw ? withError(view, scene, draw(dice)) : view;
    const auto depth = rooms::withNoise(image, scene.width, scene.height, camera::DepthNoise(), dice);
    const auto found =
        PlaneSegmenter(options).segment(camera::DepthImage(depth.data(), scene.width, scene.height, scene.camera));
    for (std::size_t f = 0; f < scene.faces.size(); ++f) {
      const auto expected = rooms::planeOf(scene.faces[f]);
      for (const PlaneRegion& plane : found.planes) {
        if (plane.plane_in_sensor.normal.dot(expected.normal) < 0.9) continue;
        // The error is in the tangent of the measured plane, in which its covariance is given.
        const Eigen::Vector3d error = geometry::minus(expected, plane.plane_in_sensor);
        chi2[f].push_back(error.dot(plane.covariance.inverse() * error));
      }
    }
  }
  return chi2;
}

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

// The mean of 200 samples of chi-square with 3 degrees of freedom has a standard deviation of sqrt(6 / 200).
const double kFar = 1.96 * std::sqrt(6.0 / kRenderings);

TEST(PlaneQuality, TheCovarianceIsThatOfTwoHundredNoisyRenderings) {
  PlaneOptions options;
  options.distortion_at_1m = options.scale_sigma = 0;
  for (const auto& chi2 : chi2OfRenderings(options, nullptr)) {
    ASSERT_EQ(chi2.size(), kRenderings);
    EXPECT_NEAR(meanOf(chi2), 3, kFar);
  }
}

TEST(PlaneQuality, TheCovarianceCountsAScaleOfDepthsDrawnForEachRendering) {
  PlaneOptions options;
  options.distortion_at_1m = 0;
  options.scale_sigma = 0.02;
  const auto draw = [](testing::Dice& dice) -> SharedError {
    const double scale = dice.normal(0.02);
    return [scale](double inverse, const Eigen::Vector2d&) { return -scale * inverse / (1 + scale); };
  };
  for (const auto& chi2 : chi2OfRenderings(options, draw)) {
    ASSERT_EQ(chi2.size(), kRenderings);
    EXPECT_NEAR(meanOf(chi2), 3, kFar);
  }
  options.scale_sigma = 0;
  for (const auto& chi2 : chi2OfRenderings(options, draw)) EXPECT_GT(meanOf(chi2), 100) << "by noise alone";
}

// A smooth random field with that standard deviation and a correlation length of `reach` between rays (x/z, y/z), as
// the sum of many random waves.
SharedError distortion(double sigma, double reach, testing::Dice& dice) {
  struct Wave {
    Eigen::Vector2d number;
    double phase;
  };
  constexpr int kWaves = 12;
  std::vector<Wave> waves;
  for (int i = 0; i < kWaves; ++i)
    waves.push_back({{dice.normal(1 / reach), dice.normal(1 / reach)}, dice.uniform(0, 2 * M_PI)});
  return [=](double, const Eigen::Vector2d& ray) {
    double sum = 0;
    for (const Wave& wave : waves) sum += std::cos(wave.number.dot(ray) + wave.phase);
    return sigma * std::sqrt(2.0 / kWaves) * sum;
  };
}

TEST(PlaneQuality, TheCovarianceCountsASystematicDistortionDrawnForEachRendering) {
  const PlaneOptions options;
  const auto draw = [&](testing::Dice& dice) { return distortion(0.5 * options.distortion_at_1m, 0.3, dice); };
  for (const auto& chi2 : chi2OfRenderings(options, draw)) {
    // A wall with a large distortion may be split in two. The covariance also includes an error of scale, which there
    // is none of here.
    EXPECT_GT(static_cast<int>(chi2.size()), 0.95 * kRenderings);
    EXPECT_LT(meanOf(chi2), 3 + kFar);
    EXPECT_GT(meanOf(chi2), 1.5);
    const auto beyond = std::count_if(chi2.begin(), chi2.end(), [](double value) { return value > 7.815; });
    EXPECT_LT(static_cast<double>(beyond), 0.08 * static_cast<double>(chi2.size())) << "5 % are beyond 7.815";
  }
}

}  // namespace
}  // namespace omnimapper::perception::plane_quality_test
