#include "MapPicture.h"

#include <algorithm>
#include <cmath>

#include "ScaleBar.h"

namespace omnimapper::plugins {

namespace {

constexpr Rgb kPaper{255, 255, 255}, kTrack{37, 99, 235}, kClosure{22, 163, 74};

PixelPoint pixelOf(const GridPicture& grid, const mrpt::math::TPoint3D& point) {
  return grid.pixelOf(point.x, point.y);
}

double distanceToLine(PixelPoint p, PixelPoint a, PixelPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
  const double along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (length * length), 0.0, 1.0);
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

std::vector<PixelPoint> simplified(const std::vector<PixelPoint>& all, double tolerance) {
  if (all.size() < 3) return all;
  // Keep the point furthest from the chord while it is too far; a stack in place of recursion (Ramer-Douglas-Peucker).
  std::vector<bool> kept(all.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, all.size() - 1}};
  while (!spans.empty()) {
    const auto [begin, end] = spans.back();
    spans.pop_back();
    std::size_t furthest = begin;
    double distance = tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double here = distanceToLine(all[i], all[begin], all[end]);
      if (here > distance) furthest = i, distance = here;
    }
    if (furthest == begin) continue;
    kept[furthest] = true;
    spans.emplace_back(begin, furthest);
    spans.emplace_back(furthest, end);
  }
  std::vector<PixelPoint> path;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i]) path.push_back(all[i]);
  }
  return path;
}

}  // namespace

Image drawMap(const GridPicture& grid, const std::vector<map::StampedPose>& trajectory,
              const std::vector<Closure>& closures) {
  Image image(grid.image.width, grid.image.height, kPaper);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = grid.image.palette[grid.image.pixels[i]];
  // Thin, so that walls are seen beside and under them.
  const double width = std::max(1.2, std::max(image.width, image.height) / 900.0);
  for (const Closure& closure : closures) {
    if (!closure.decision->accepted) continue;
    drawLine(image, pixelOf(grid, closure.from), pixelOf(grid, closure.to), {kClosure, width, 0.6});
  }
  const auto paths = simplifiedPaths(grid, trajectory, 0.25);
  for (const auto& path : paths) drawPath(image, path, {kTrack, width, 0.9});
  for (const auto& path : paths) {
    drawDot(image, path.front(), {kTrack, 7 * width});
    drawDot(image, path.front(), {kPaper, 4 * width});
    drawDot(image, path.back(), {kPaper, 8 * width});
    drawDot(image, path.back(), {kTrack, 6 * width});
  }
  drawScaleBar(image, grid);
  return image;
}

std::optional<GridPicture> emptyPicture(const std::vector<map::StampedPose>& trajectory, double margin, int side) {
  if (trajectory.empty()) return std::nullopt;
  const auto first = trajectory.front().map_from_base.translation();
  double min_x = first.x, max_x = first.x, min_y = first.y, max_y = first.y;
  for (const auto& pose : trajectory) {
    const auto p = pose.map_from_base.translation();
    min_x = std::min(min_x, p.x), max_x = std::max(max_x, p.x);
    min_y = std::min(min_y, p.y), max_y = std::max(max_y, p.y);
  }
  const double width = max_x - min_x + 2 * margin, height = max_y - min_y + 2 * margin;
  GridPicture picture;
  picture.metres_per_pixel = std::max(width, height) / side;
  picture.min_x = min_x - margin;
  picture.max_y = max_y + margin;
  picture.image.width = std::max(1, static_cast<int>(std::lround(width / picture.metres_per_pixel)));
  picture.image.height = std::max(1, static_cast<int>(std::lround(height / picture.metres_per_pixel)));
  picture.image.palette = {kPaper};
  picture.image.pixels.assign(static_cast<std::size_t>(picture.image.width) * picture.image.height, 0);
  return picture;
}

std::vector<std::vector<PixelPoint>> simplifiedPaths(const GridPicture& grid,
                                                     const std::vector<map::StampedPose>& trajectory,
                                                     double tolerance) {
  std::vector<std::vector<PixelPoint>> paths;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (i == 0 || trajectory[i].session != trajectory[i - 1].session) paths.emplace_back();
    paths.back().push_back(pixelOf(grid, trajectory[i].map_from_base.translation()));
  }
  for (auto& path : paths) path = simplified(path, tolerance);
  return paths;
}

}  // namespace omnimapper::plugins
