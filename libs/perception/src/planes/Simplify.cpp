#include "Simplify.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace omnimapper::perception::planes {

namespace {

double squaredDistance(const PixelCorner& a, const PixelCorner& b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

// Of a point from the stretch between two others.
double squaredDistance(const PixelCorner& p, const PixelCorner& from, const PixelCorner& to) {
  const double x = to.x - from.x, y = to.y - from.y, px = p.x - from.x, py = p.y - from.y;
  const double squared_length = x * x + y * y;
  const double share = squared_length > 0 ? std::clamp((px * x + py * y) / squared_length, 0., 1.) : 0;
  const double dx = px - share * x, dy = py - share * y;
  return dx * dx + dy * dy;
}

}  // namespace

std::vector<int> simplified(const std::vector<PixelCorner>& corners, double tolerance) {
  const auto count = static_cast<int>(corners.size());
  const auto corner = [&](int i) -> const PixelCorner& { return corners[static_cast<std::size_t>(i % count)]; };
  std::vector<int> all(corners.size());
  std::iota(all.begin(), all.end(), 0);
  if (count < 4 || tolerance <= 0) return all;
  // A corner and the one farthest from it are kept; between them either half is an open line.
  int opposite = 0;
  for (int i = 1; i < count; ++i) {
    if (squaredDistance(corner(i), corner(0)) > squaredDistance(corner(opposite), corner(0))) opposite = i;
  }
  std::vector<bool> kept(corners.size(), false);
  kept[0] = kept[static_cast<std::size_t>(opposite)] = true;
  std::vector<std::pair<int, int>> stretches{{0, opposite}, {opposite, count}};
  while (!stretches.empty()) {
    const auto [from, to] = stretches.back();
    stretches.pop_back();
    int farthest = from;
    double distance = tolerance * tolerance;
    for (int i = from + 1; i < to; ++i) {
      const double d = squaredDistance(corner(i), corner(from), corner(to));
      if (d > distance) distance = d, farthest = i;
    }
    if (farthest == from) continue;
    kept[static_cast<std::size_t>(farthest)] = true;
    stretches.emplace_back(from, farthest);
    stretches.emplace_back(farthest, to);
  }
  std::vector<int> result;
  std::copy_if(all.begin(), all.end(), std::back_inserter(result),
               [&](int i) { return kept[static_cast<std::size_t>(i)]; });
  return result.size() < 3 ? all : result;
}

}  // namespace omnimapper::perception::planes
