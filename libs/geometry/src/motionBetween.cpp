#include <omnimapper/geometry/motionBetween.h>

#include <cmath>

namespace omnimapper::geometry {

Se2 motionBetween(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& pairs) {
  Eigen::Vector2d from(0, 0), to(0, 0);
  const auto count = static_cast<double>(pairs.size());
  for (const auto& [a, b] : pairs) from += a / count, to += b / count;
  double cosine = 0, sine = 0;
  for (const auto& [a, b] : pairs) {
    const Eigen::Vector2d p = a - from, q = b - to;
    cosine += p.dot(q);
    sine += p.x() * q.y() - p.y() * q.x();
  }
  const Se2 turn{0, 0, std::atan2(sine, cosine)};
  const Eigen::Vector2d shift = to - turn * from;
  return {shift.x(), shift.y(), turn.yaw};
}

}  // namespace omnimapper::geometry
