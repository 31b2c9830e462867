#include <omnimapper/matching/SpanContradiction.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

Eigen::Matrix2d SpanContradiction::add(double seconds, const Eigen::Vector2d& difference,
                                       const Eigen::Matrix2d& covariance) {
  constexpr double kSpans[] = {0.5, 2, 8};  // [s]
  constexpr double kBeyond = 20;            // squared standard deviations, because many spans are tested
  constexpr double kLeastMetres = 0.1;      // that matter
  const double step = recent_.empty() ? 0 : seconds - recent_.back().seconds;
  recent_.push_back({seconds, difference, covariance});
  while (seconds - recent_.front().seconds > kSpans[2]) recent_.pop_front();
  Eigen::Matrix2d added = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d variance = 1e-9 * Eigen::Matrix2d::Identity();
  auto oldest = recent_.rbegin();
  for (const double span : kSpans) {
    for (; oldest != recent_.rend() && seconds - oldest->seconds < span; ++oldest) {
      sum += oldest->difference;
      variance += oldest->covariance;
    }
    if (sum.norm() < kLeastMetres || sum.dot(variance.inverse() * sum) < kBeyond) continue;
    const Eigen::Matrix2d of_span = sum * sum.transpose() * std::min(1.0, step / span);
    if (of_span.trace() > added.trace()) added = of_span;
    largest_ = std::max(largest_, sum.norm());
  }
  if (added.isZero()) return added;
  if (contradicted_seconds_ == 0) first_seconds_ = seconds;
  contradicted_seconds_ += step;
  return added;
}

}  // namespace omnimapper::matching
