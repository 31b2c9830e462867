#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

namespace omnimapper::bench {

/// Uncertainties of a scene, as standard deviations, and the share of clutter.
struct SceneNoise {
  double place = 0.5;               ///< of the base, along x and along y [m]
  double heading = 3 * M_PI / 180;  ///< of the base [rad]
  double landmark = 0.05;           ///< of each landmark in the map, along x and along y [m]
  double measurement = 0.05;        ///< of a measured point in the base, along x and along y [m]
  double clutter = 0.2;             ///< share of measurements of no landmark in the map
};

/// Point landmarks in a map of 20 by 20 m with the base in its middle, and points that are measured together from
/// there.
struct PointScene {
  static constexpr double kSide = 20;              ///< [m]
  std::vector<Eigen::Vector2d> measured_in_base;   ///< [m]
  std::vector<std::optional<std::size_t>> truth;   ///< landmark of each measurement; none for clutter
  std::vector<Eigen::Vector2d> predicted_in_base;  ///< position of each landmark in the map [m]
  Eigen::MatrixXd covariance;  ///< [m^2] of measured minus predicted points, with measurement noise; 2 rows a landmark

  PointScene(std::size_t landmarks, std::size_t measurements, const SceneNoise& noise, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> within(-kSide / 2, kSide / 2), share(0, 1);
    const auto anywhere = [&] {
      const double x = within(random);
      return Eigen::Vector2d(x, within(random));
    };
    const auto error = [&](double sigma) {
      const double x = sigma * normal(random);
      return Eigen::Vector2d(x, sigma * normal(random));
    };
    // In the map the base is at the origin and looks along x, so predictions in the base are the landmarks themselves.
    for (std::size_t i = 0; i < landmarks; ++i) predicted_in_base.push_back(anywhere());
    const Eigen::Vector2d place = error(noise.place);
    const Eigen::Rotation2Dd base_from_map_rotation(-noise.heading * normal(random));
    std::vector<std::size_t> remaining(landmarks);
    std::iota(remaining.begin(), remaining.end(), std::size_t{0});
    std::shuffle(remaining.begin(), remaining.end(), random);
    for (std::size_t m = 0; m < measurements; ++m) {
      const bool clutter = share(random) < noise.clutter || remaining.empty();
      truth.push_back(clutter ? std::nullopt : std::optional(remaining.back()));
      Eigen::Vector2d in_map = anywhere();
      if (!clutter) {
        in_map = predicted_in_base[remaining.back()] + error(noise.landmark);
        remaining.pop_back();
      }
      measured_in_base.push_back(base_from_map_rotation * (in_map - place) + error(noise.measurement));
    }
    setCovariance(noise);
  }

  /// 2 x 2 block of the covariance of two landmarks.
  Eigen::Matrix2d covarianceOf(std::size_t a, std::size_t b) const {
    return covariance.block<2, 2>(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b));
  }

 private:
  void setCovariance(const SceneNoise& noise) {
    const auto rows = static_cast<Eigen::Index>(2 * predicted_in_base.size());
    Eigen::MatrixXd by_pose(rows, 3);
    for (std::size_t i = 0; i < predicted_in_base.size(); ++i) {
      const Eigen::Vector2d& at = predicted_in_base[i];
      by_pose.middleRows<2>(static_cast<Eigen::Index>(2 * i)) << -1, 0, at.y(), 0, -1, -at.x();
    }
    const Eigen::Vector3d sigmas(noise.place, noise.place, noise.heading);
    covariance = by_pose * sigmas.cwiseAbs2().asDiagonal() * by_pose.transpose();
    covariance.diagonal().array() += noise.landmark * noise.landmark + noise.measurement * noise.measurement;
  }
};

}  // namespace omnimapper::bench
