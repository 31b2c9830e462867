#include <omnimapper/base/Error.h>
#include <omnimapper/matching/deskew.h>

#include <cmath>
#include <string>

namespace omnimapper::matching {

namespace {

// The chord of an arc of an angle a, along and across its beginning, for an arc of unit length: sin(a) / a and (1 -
// cos(a)) / a.
struct Arc {
  double along, across;
  explicit Arc(double angle)
      : along(std::abs(angle) < 1e-6 ? 1 : std::sin(angle) / angle),
        across(std::abs(angle) < 1e-6 ? 0.5 * angle : (1 - std::cos(angle)) / angle) {}
};

}  // namespace

std::vector<Eigen::Vector2f> deskew(const std::vector<Eigen::Vector2f>& points, const std::vector<float>& fractions,
                                    const mrpt::math::TPose2D& begin_from_end) {
  if (fractions.size() != points.size()) {
    throw base::Error(base::ExitCode::internal, "deskew: " + std::to_string(points.size()) + " points, but " +
                                                    std::to_string(fractions.size()) + " fractions of the sweep");
  }
  // The velocity in the moving frame, which is constant over the sweep.
  const double turn = begin_from_end.phi;
  const Arc whole(turn);
  const double squared = whole.along * whole.along + whole.across * whole.across;
  const double vx = (whole.along * begin_from_end.x + whole.across * begin_from_end.y) / squared,
               vy = (whole.along * begin_from_end.y - whole.across * begin_from_end.x) / squared;
  std::vector<Eigen::Vector2f> still;
  still.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double f = fractions[i], c = std::cos(f * turn), s = std::sin(f * turn);
    const Arc arc(f * turn);
    const double tx = f * (arc.along * vx - arc.across * vy), ty = f * (arc.across * vx + arc.along * vy);
    const double x = points[i].x(), y = points[i].y();
    still.emplace_back(tx + c * x - s * y, ty + s * x + c * y);
  }
  return still;
}

}  // namespace omnimapper::matching
