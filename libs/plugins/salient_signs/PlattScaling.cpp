#include "PlattScaling.h"

#include <cmath>

namespace omnimapper::signs {

namespace {

constexpr int kNewtonSteps = 100;
constexpr double kShortestStep = 1e-10;
constexpr double kRidge = 1e-12;  // keeps the Hessian regular

struct Sums {
  double loss = 0, by_slope = 0, by_offset = 0, slope_slope = 0, slope_offset = 0, offset_offset = 0;

  // Adds the cross entropy of a value whose probability should be `target`, and its derivatives.
  void add(double y, double target, double weight, const PlattScaling& at) {
    const double z = at.slope * y + at.offset, p = 1 / (1 + std::exp(z));
    loss += weight * (z >= 0 ? target * z + std::log1p(std::exp(-z)) : (target - 1) * z + std::log1p(std::exp(z)));
    const double first = weight * (target - p), second = weight * p * (1 - p);
    by_slope += first * y, by_offset += first;
    slope_slope += second * y * y, slope_offset += second * y, offset_offset += second;
  }
};

}  // namespace

PlattScaling fitPlatt(const std::vector<double>& of_signs, const std::vector<double>& of_others) {
  const auto signs = static_cast<double>(of_signs.size()), others = static_cast<double>(of_others.size());
  const double sign_target = (signs + 1) / (signs + 2), other_target = 1 / (others + 2);
  const auto sumsAt = [&](const PlattScaling& at) {
    Sums sums;
    for (const double y : of_signs) sums.add(y, sign_target, 0.5 / signs, at);
    for (const double y : of_others) sums.add(y, other_target, 0.5 / others, at);
    return sums;
  };
  PlattScaling best;
  Sums sums = sumsAt(best);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const double a = sums.slope_slope + kRidge, b = sums.slope_offset, c = sums.offset_offset + kRidge,
                 determinant = a * c - b * b;
    const double slope = -(c * sums.by_slope - b * sums.by_offset) / determinant,
                 offset = -(a * sums.by_offset - b * sums.by_slope) / determinant;
    double length = 1;
    for (; length > kShortestStep; length /= 2) {
      const PlattScaling next{best.slope + length * slope, best.offset + length * offset};
      const Sums there = sumsAt(next);
      if (there.loss < sums.loss) {
        best = next;
        sums = there;
        break;
      }
    }
    if (length <= kShortestStep || length * (std::abs(slope) + std::abs(offset)) < 1e-9) break;
  }
  return best;
}

}  // namespace omnimapper::signs
