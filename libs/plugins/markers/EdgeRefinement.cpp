#include "EdgeRefinement.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::perception::markers {

namespace {

using Eigen::Vector2d;

constexpr double kSpared = 0.08;   // share of a side that is left out at either corner
constexpr double kStep = 0.25;     // [px] between the samples of a profile
constexpr double kLeastStep = 10;  // of the grey value, from black to white

// Grey value, interpolated between the pixels; those at the border continue outside.
double greyAt(const camera::ColourImage& picture, const Vector2d& place) {
  const double u = std::clamp<double>(place.x(), 0, picture.width - 1.001);
  const double v = std::clamp<double>(place.y(), 0, picture.height - 1.001);
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const double right = u - column, down = v - row;
  const std::uint8_t* p = picture.pixels + static_cast<std::ptrdiff_t>(row) * picture.stride + column;
  const std::uint8_t* q = p + picture.stride;
  return (1 - down) * ((1 - right) * p[0] + right * p[1]) + down * ((1 - right) * q[0] + right * q[1]);
}

struct Line {
  Vector2d point, direction;
};

// The line along a side, from one corner to the next with the inside of the marker on the right; none where the picture
// shows no step from black to white. `border` [px]: width of the marker's black border.
std::optional<Line> sideBetween(const camera::ColourImage& picture, const Vector2d& from, const Vector2d& to,
                                double border) {
  const Vector2d along = to - from;
  const double length = along.norm();
  if (!(length > 1)) return std::nullopt;
  const Vector2d outward = Vector2d(along.y(), -along.x()) / length;
  const double reach = std::clamp(0.5 * border, 1.25, 4.);
  const int profiles = std::clamp(static_cast<int>(length), 8, 100),
            half = static_cast<int>(std::lround(reach / kStep));
  std::vector<double> sums;
  double black = 0, white = 0;
  for (int i = 0; i < profiles; ++i) {
    const Vector2d middle = from + (kSpared + (1 - 2 * kSpared) * (i + 0.5) / profiles) * along;
    const auto at = [&](int k) { return greyAt(picture, middle + k * kStep * outward); };
    double sum = 0.5 * (at(-half) + at(half));
    for (int k = 1 - half; k < half; ++k) sum += at(k);
    sums.push_back(sum);
    black += at(-half) / profiles;
    white += at(half) / profiles;
  }
  if (white - black < kLeastStep) return std::nullopt;
  std::vector<Vector2d> places;
  Vector2d mean = Vector2d::Zero();
  for (int i = 0; i < profiles; ++i) {
    const Vector2d middle = from + (kSpared + (1 - 2 * kSpared) * (i + 0.5) / profiles) * along;
    const double blackened = (2 * half * white - sums[static_cast<std::size_t>(i)]) / (white - black);  // in kStep
    places.push_back(middle + std::clamp<double>(blackened - half, -half, half) * kStep * outward);
    mean += places.back() / profiles;
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto& place : places) scatter += (place - mean) * (place - mean).transpose();
  return Line{mean, geometry::eigenOf<2>(scatter).vectors.col(1)};
}

std::optional<Vector2d> crossing(const Line& a, const Line& b) {
  constexpr double kParallel = 0.05;  // sine of the angle
  Eigen::Matrix2d directions;
  directions << a.direction, -b.direction;
  if (std::abs(directions.determinant()) < kParallel) return std::nullopt;
  return a.point + (directions.inverse() * (b.point - a.point))[0] * a.direction;
}

}  // namespace

camera::Corners refinedByEdges(const camera::ColourImage& picture, const camera::Corners& corners, int cells) {
  constexpr int kRounds = 3;
  constexpr double kFarthest = 3;  // [px] that a corner may move
  camera::Corners result = corners;
  for (int round = 0; round < kRounds; ++round) {
    std::array<Line, 4> sides;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector2d &from = result[i], &to = result[(i + 1) % 4];
      const double beside = std::min((result[(i + 3) % 4] - from).norm(), (result[(i + 2) % 4] - to).norm());
      const auto side = sideBetween(picture, from, to, beside / cells);
      if (!side) return corners;
      sides[i] = *side;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto corner = crossing(sides[(i + 3) % 4], sides[i]);
      if (!corner || !((*corner - corners[i]).norm() < kFarthest)) return corners;
      result[i] = *corner;
    }
  }
  return result;
}

}  // namespace omnimapper::perception::markers
