#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "DepthFrames.h"

namespace omnimapper::bench {

/// x -> y, only where there are enough samples.
using Curve = std::map<double, double>;

/// Statistics of a depth camera, computed alike from recorded and simulated frames.
struct DepthStatistics {
  Curve noise;             ///< distance [m] -> residual of the flattest quarter of the local planes [mm]
  Curve step;              ///< distance [m] -> median of the steps between depths that occur [mm]
  Curve lit_gap;           ///< disparity step [pixel] -> mean width [pixel] of the hole at it, near side on the left
  Curve shadow_gap;        ///< the same, near side on the right, where the projector's shadow is
  Curve missing_at_angle;  ///< angle of incidence [deg] -> missing pixels of a flat patch [%]
  std::array<double, 4> correlation{};  ///< of residuals that are 1, 2, 4 and 8 pixels apart, on near planes
  double missing = 0;                   ///< missing depths [%] among the pixels that have a depth in at least one frame
};

namespace detail {

constexpr double kFocalBaseline = 580 * 0.075;  // [pixel m] disparities are those of a Kinect

inline double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// A plane fitted through the valid pixels of a square patch. A plane is linear in disparity.
struct Patch {
  double depth = 0, rms = 0, angle = 0, valid = 0;  // [m], [pixel of disparity], [deg], share of valid pixels
  std::vector<double> residuals;                    // row by row [pixel]
};

inline std::optional<Patch> fit(const DepthFrame& frame, int left, int top, int side, double need) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double middle = 0.5 * (side - 1);
  int valid = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double depth = frame.at(left + x, top + y);
      if (depth <= 0) continue;
      const Eigen::Vector3d row(1, x - middle, y - middle);
      normal += row * row.transpose();
      right += row * (kFocalBaseline / depth);
      ++valid;
    }
  }
  Patch patch;
  patch.valid = static_cast<double>(valid) / (side * side);
  if (patch.valid < need) return std::nullopt;
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  double sum = 0, most = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double depth = frame.at(left + x, top + y);
      const double residual =
          depth > 0 ? kFocalBaseline / depth - plane.dot(Eigen::Vector3d(1, x - middle, y - middle)) : 0;
      patch.residuals.push_back(residual);
      sum += residual * residual;
      most = std::max(most, std::abs(residual));
    }
  }
  if (plane[0] <= 0 || most > 1.5) return std::nullopt;  // an edge
  patch.rms = std::sqrt(sum / (valid - 3));
  patch.depth = kFocalBaseline / plane[0];
  // Disparity is linear in pixel coordinates; its slopes are the components of the normal over the plane's distance.
  const double u = left + middle - 0.5 * (frame.width - 1), v = top + middle - 0.5 * (frame.height - 1);
  const Eigen::Vector3d facing(plane[1] * frame.focal, plane[2] * frame.focal, plane[0] - plane[1] * u - plane[2] * v);
  const Eigen::Vector3d ray(u / frame.focal, v / frame.focal, 1);
  patch.angle = std::acos(std::min(1.0, std::abs(facing.normalized().dot(ray.normalized())))) * 180 / M_PI;
  return patch;
}

template <class Visit>
void forEachPatch(const std::vector<DepthFrame>& frames, int side, double need, Visit visit) {
  for (const DepthFrame& frame : frames) {
    for (int top = 0; top + side <= frame.height; top += side) {
      for (int left = 0; left + side <= frame.width; left += side) {
        if (const auto patch = fit(frame, left, top, side, need)) visit(*patch);
      }
    }
  }
}

inline double bin(double value, double width) {
  return width * (std::floor(value / width) + 0.5);
}

}  // namespace detail

inline Curve noiseOverDistance(const std::vector<DepthFrame>& frames) {
  std::map<double, std::vector<double>> residuals;
  detail::forEachPatch(frames, 13, 1.0, [&](const detail::Patch& patch) {
    if (patch.angle < 60)
      residuals[detail::bin(patch.depth, 0.25)].push_back(1000 * patch.rms * patch.depth * patch.depth /
                                                          detail::kFocalBaseline);
  });
  Curve curve;
  for (auto& [depth, values] : residuals) {
    if (values.size() >= 40) curve[depth] = detail::quantile(values, 0.25);
  }
  return curve;
}

inline std::array<double, 4> residualCorrelation(const std::vector<DepthFrame>& frames) {
  constexpr int kSide = 25;
  constexpr std::array<int, 4> kLags{1, 2, 4, 8};
  std::array<double, 4> products{};
  double squares = 0;
  detail::forEachPatch(frames, kSide, 1.0, [&](const detail::Patch& patch) {
    if (patch.depth > 1.6 || patch.angle > 60 || patch.rms > 0.15) return;
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column + kLags.back() < kSide; ++column) {
        const double here = patch.residuals[row * kSide + column];
        squares += here * here;
        for (std::size_t i = 0; i < kLags.size(); ++i)
          products[i] += here * patch.residuals[row * kSide + column + kLags[i]];
      }
    }
  });
  for (double& product : products) product /= squares;
  return products;
}

inline Curve stepOverDistance(const std::vector<DepthFrame>& frames) {
  std::set<float> depths;
  for (const DepthFrame& frame : frames) depths.insert(frame.depths.begin(), frame.depths.end());
  depths.erase(0.0f);
  std::map<double, std::vector<double>> steps;
  for (auto at = depths.begin(); at != depths.end() && std::next(at) != depths.end(); ++at)
    steps[detail::bin(*at, 0.25)].push_back(1000 * (*std::next(at) - *at));
  Curve curve;
  for (auto& [depth, values] : steps) {
    if (values.size() >= 3) curve[depth] = detail::quantile(values, 0.5);
  }
  return curve;
}

/// Adds the mean widths of holes along rows between depths whose disparities differ by more than 2 pixels.
inline void addGaps(const std::vector<DepthFrame>& frames, Curve& lit, Curve& shadow) {
  constexpr int kLongest = 60;
  std::map<double, std::pair<double, int>> sums[2];
  for (const DepthFrame& frame : frames) {
    for (int row = 0; row < frame.height; ++row) {
      int last = -1;
      for (int column = 0; column < frame.width; ++column) {
        if (frame.at(column, row) <= 0) continue;
        if (last >= 0 && column - last - 1 <= kLongest) {
          const double disparity_step =
              detail::kFocalBaseline / frame.at(column, row) - detail::kFocalBaseline / frame.at(last, row);
          if (std::abs(disparity_step) > 2 && std::abs(disparity_step) < 30) {
            auto& [sum, count] = sums[disparity_step > 0][detail::bin(std::abs(disparity_step), 2)];
            sum += column - last - 1;
            ++count;
          }
        }
        last = column;
      }
    }
  }
  for (const bool near_is_right : {false, true}) {
    for (const auto& [disparity_step, entry] : sums[near_is_right]) {
      if (entry.second >= 100) (near_is_right ? shadow : lit)[disparity_step] = entry.first / entry.second;
    }
  }
}

inline Curve missingOverAngle(const std::vector<DepthFrame>& frames) {
  std::map<double, std::pair<double, int>> sums;
  detail::forEachPatch(frames, 13, 0.4, [&](const detail::Patch& patch) {
    if (patch.rms > 0.4) return;
    auto& [sum, count] = sums[detail::bin(patch.angle, 10)];
    sum += 100 * (1 - patch.valid);
    ++count;
  });
  Curve curve;
  for (const auto& [angle, entry] : sums) {
    if (entry.second >= 100) curve[angle] = entry.first / entry.second;
  }
  return curve;
}

inline double missingPart(const std::vector<DepthFrame>& frames) {
  std::vector<char> ever(frames.front().depths.size(), 0);
  for (const DepthFrame& frame : frames) {
    for (std::size_t i = 0; i < ever.size(); ++i) ever[i] = ever[i] || frame.depths[i] > 0;
  }
  double missing = 0, all = 0;
  for (const DepthFrame& frame : frames) {
    for (std::size_t i = 0; i < ever.size(); ++i) {
      all += ever[i];
      missing += ever[i] && frame.depths[i] <= 0;
    }
  }
  return 100 * missing / all;
}

inline DepthStatistics statistics(const std::vector<DepthFrame>& frames) {
  DepthStatistics all;
  all.noise = noiseOverDistance(frames);
  all.step = stepOverDistance(frames);
  addGaps(frames, all.lit_gap, all.shadow_gap);
  all.missing_at_angle = missingOverAngle(frames);
  all.correlation = residualCorrelation(frames);
  all.missing = missingPart(frames);
  return all;
}

}  // namespace omnimapper::bench
