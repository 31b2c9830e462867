#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace omnimapper::bench {

/// Metrics of a laser, computed from its scans by the same rules whether they are recorded or simulated.
class LaserMetrics {
 public:
  static constexpr double kBin = 1;  // [m] width of a bin of ranges
  /// Ranges of `farthest` [m] or more count as no echo, whatever the scan says.
  explicit LaserMetrics(double farthest = 1e9) : farthest_(farthest) {}

  struct Sum {
    double squares = 0, count = 0;
    double deviation() const { return count > 0 ? std::sqrt(squares / count) : 0; }
  };

  std::map<int, Sum> on_walls;  ///< residuals [m] of ranges to lines fitted through walls, by bin of range
  std::map<int, Sum> repeated;  ///< half the squared change [m^2] of a beam while the robot stands, by bin of range
  double beams = 0, no_echo = 0;
  static constexpr std::array<double, 5> kGaps{0.3, 0.6, 1.2, 2.4, 4.8};  // [m] limits of the classes of depth gaps
  std::array<double, 4> edges{}, mixed{};  ///< edges by class of gap, and those with a point between both sides

  /// `stands`: the robot has not moved since the scan before.
  void add(const mrpt::obs::CObservation2DRangeScan& scan, bool stands) {
    std::vector<double> ranges;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
      const auto range = static_cast<double>(scan.getScanRange(i));
      const bool valid = scan.getScanRangeValidity(i) && range > 0.05 &&
                         range < std::min(farthest_, static_cast<double>(scan.maxRange));
      ranges.push_back(valid ? range : 0);
      ++beams, no_echo += !valid;
    }
    addWalls(scan, ranges);
    addEdges(ranges);
    // Odometry is rounded, so the robot counts as standing only after four scans without motion.
    stood_ = stands ? stood_ + 1 : 0;
    if (stood_ >= 4 && ranges.size() == last_.size()) {
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        const double change = ranges[i] - last_[i];
        if (ranges[i] <= 0 || last_[i] <= 0 || std::abs(change) > 0.15) continue;
        auto& sum = repeated[static_cast<int>(ranges[i] / kBin)];
        sum.squares += 0.5 * change * change, ++sum.count;
      }
    }
    last_ = std::move(ranges);
  }

 private:
  // Adds the residuals of groups of 15 beams that form a line and meet it within 50 degrees of its normal.
  void addWalls(const mrpt::obs::CObservation2DRangeScan& scan, const std::vector<double>& ranges) {
    constexpr std::size_t kLength = 15;
    const double aperture = static_cast<double>(scan.aperture),
                 step = aperture / (static_cast<double>(ranges.size()) - 1);
    for (std::size_t first = 0; first + kLength <= ranges.size();) {
      Eigen::Matrix<double, 2, kLength> points, rays;
      bool good = true;
      for (std::size_t i = 0; i < kLength && good; ++i) {
        const double range = ranges[first + i], angle = -0.5 * aperture + step * static_cast<double>(first + i);
        good = range > 0 && (i == 0 || std::abs(range - ranges[first + i - 1]) < 0.05 + 0.08 * range);
        rays.col(i) << std::cos(angle), std::sin(angle);
        points.col(i) = range * rays.col(i);
      }
      if (!good) {
        ++first;
        continue;
      }
      const Eigen::Vector2d mean = points.rowwise().mean();
      const Eigen::Matrix2d scatter = (points.colwise() - mean) * (points.colwise() - mean).transpose();
      const Eigen::Vector2d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(0);
      double squares = 0, worst = 0;
      for (std::size_t i = 0; i < kLength && good; ++i) {
        const double along = normal.dot(rays.col(i));
        good = std::abs(along) > std::cos(50 * M_PI / 180);
        const double residual = ranges[first + i] - normal.dot(mean) / along;
        squares += residual * residual, worst = std::max(worst, std::abs(residual));
      }
      // Walls have frames and mouldings: if a point is more than 4 cm off, the group is no flat wall.
      if (!good || worst > 0.04 + 0.003 * mean.norm()) {
        ++first;
        continue;
      }
      auto& sum = on_walls[static_cast<int>(mean.norm() / kBin)];
      sum.squares += squares, sum.count += kLength - 2;
      first += kLength;
    }
  }

  // An edge: two beams on a near object and two on a far one, with no point or one point between them.
  void addEdges(const std::vector<double>& ranges) {
    const auto smooth = [&](std::size_t i) {
      return ranges[i] > 0 && ranges[i + 1] > 0 && std::abs(ranges[i] - ranges[i + 1]) < 0.05 + 0.02 * ranges[i];
    };
    const auto bin = [&](double gap) {
      for (std::size_t b = 0; b + 1 < kGaps.size(); ++b) {
        if (gap >= kGaps[b] && gap < kGaps[b + 1]) return static_cast<int>(b);
      }
      return -1;
    };
    for (std::size_t i = 1; i + 3 < ranges.size(); ++i) {
      if (!smooth(i - 1)) continue;
      const int direct = bin(std::abs(ranges[i + 1] - ranges[i])), around = bin(std::abs(ranges[i + 2] - ranges[i]));
      const double low = std::min(ranges[i], ranges[i + 2]) + 0.12, high = std::max(ranges[i], ranges[i + 2]) - 0.12;
      if (around >= 0 && smooth(i + 2) && ranges[i + 1] > low && ranges[i + 1] < high) {
        ++edges[around], ++mixed[around];
      } else if (direct >= 0 && smooth(i + 1)) {
        ++edges[direct];
      }
    }
  }

  double farthest_;
  int stood_ = 0;
  std::vector<double> last_;
};

}  // namespace omnimapper::bench
