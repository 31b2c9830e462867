#include "MapPicture.h"

#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/derived/ScaleBar.h>
#include <omnimapper/derived/SessionColours.h>
#include <omnimapper/draw/LabelColours.h>
#include <omnimapper/draw/Legend.h>
#include <omnimapper/geometry/Simplify.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace omnimapper::plugins {

namespace {

constexpr draw::Rgb kPaper{255, 255, 255}, kClosure{22, 163, 74};

draw::PixelPoint pixelOf(const derived::GridPicture& grid, const mrpt::math::TPoint3D& point) {
  return grid.pixelOf(point.x, point.y);
}

std::vector<draw::PixelPoint> pixelsOf(const derived::GridPicture& grid, const derived::PlanArea& area) {
  std::vector<draw::PixelPoint> pixels;
  for (const auto& corner : area) pixels.push_back(grid.pixelOf(corner.x(), corner.y()));
  return pixels;
}

void drawBroken(draw::Image& image, draw::PixelPoint from, draw::PixelPoint to, const draw::Pen& pen) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  for (const auto& [begin, end] : derived::dashesOf(std::hypot(dx, dy), 4 * pen.width)) {
    drawLine(image, {from.x + begin * dx, from.y + begin * dy}, {from.x + end * dx, from.y + end * dy}, pen);
  }
}

void drawAreas(draw::Image& image, const derived::GridPicture& grid,
               const std::vector<derived::ShapedLandmark>& landmarks, double width) {
  for (const auto& landmark : landmarks) {
    const auto& label = landmark.shape.label;
    if (draw::coversThePlan(label)) continue;
    const draw::Pen outline{draw::colourOfLabel(label), width, 0.9},
        fill{draw::colourOfLabel(label), 0, landmark.isFaint() ? 0.1 : 0.28};
    for (const auto& area : derived::fromAbove(landmark.shape).areas) {
      const auto walk = pixelsOf(grid, area);
      if (!landmark.moved) fillAreas(image, {walk}, fill);
      for (std::size_t i = 0, j = walk.size() - 1; i < walk.size(); j = i++)
        landmark.moved ? drawBroken(image, walk[j], walk[i], outline) : drawLine(image, walk[j], walk[i], outline);
    }
  }
}

void drawLinesAndPoints(draw::Image& image, const derived::GridPicture& grid,
                        const std::vector<derived::ShapedLandmark>& landmarks, double width) {
  for (const auto& landmark : landmarks) {
    const draw::Pen pen{draw::colourOfLabel(landmark.shape.label), (landmark.isFaint() ? 0.8 : 2.4) * width};
    const derived::PlanShape plan = derived::fromAbove(landmark.shape);
    for (const auto& [from, to] : plan.lines) {
      const auto a = grid.pixelOf(from.x(), from.y()), b = grid.pixelOf(to.x(), to.y());
      landmark.moved ? drawBroken(image, a, b, {pen.colour, width}) : drawLine(image, a, b, pen);
    }
    const bool has_track = !landmark.shape.point_stamps.empty();
    for (std::size_t i = 0; i < plan.points.size(); ++i) {
      const auto at = grid.pixelOf(plan.points[i].x(), plan.points[i].y());
      if (has_track && i > 0) {
        drawBroken(image, grid.pixelOf(plan.points[i - 1].x(), plan.points[i - 1].y()), at, {pen.colour, width});
      }
      drawDot(image, at, {kPaper, 6 * width});
      drawDot(image, at, {pen.colour, 4.5 * width});
    }
  }
}

// Draws the texts of signs beside their dots. The font has ASCII letters only.
void drawCaptions(draw::Image& image, const derived::GridPicture& grid,
                  const std::vector<derived::ShapedLandmark>& landmarks, double width) {
  for (const auto& landmark : landmarks) {
    const derived::PlanShape plan = derived::fromAbove(landmark.shape);
    if (landmark.shape.caption.empty() || landmark.isFaint() || plan.points.empty()) continue;
    std::string text = landmark.shape.caption;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    constexpr std::size_t kLongest = 24;
    if (text.size() > kLongest) text = text.substr(0, kLongest - 3) + "...";
    const auto at = grid.pixelOf(plan.points.back().x(), plan.points.back().y());
    draw::drawLabel(image, static_cast<int>(at.x + 5 * width), static_cast<int>(at.y - 7), text);
  }
}

void drawTracks(draw::Image& image, const std::vector<SessionPath>& paths, double width) {
  const auto colourOf = [](const SessionPath& path) {
    return path.is_newest ? derived::kNewestSession : derived::kEarlierSessions;
  };
  for (const auto& path : paths) drawPath(image, path.points, {colourOf(path), width, 0.9});
  for (const auto& path : paths) {
    drawDot(image, path.points.front(), {colourOf(path), 7 * width});
    drawDot(image, path.points.front(), {kPaper, 4 * width});
    drawDot(image, path.points.back(), {kPaper, 8 * width});
    drawDot(image, path.points.back(), {colourOf(path), 6 * width});
  }
}

// The legend of the colours of sessions, if there are several, and of landmarks with counts, the most frequent first.
std::vector<draw::LegendRow> legendOf(const std::vector<derived::ShapedLandmark>& landmarks, std::size_t sessions) {
  std::map<std::string, int> counts;
  for (const auto& landmark : landmarks)
    if (landmark.isSomewhere() && !draw::coversThePlan(landmark.shape.label)) ++counts[landmark.shape.label];
  std::vector<std::pair<int, std::string>> by_count;
  for (const auto& [label, count] : counts) by_count.emplace_back(-count, label);
  std::sort(by_count.begin(), by_count.end());
  std::vector<draw::LegendRow> rows;
  if (sessions > 1)
    rows = {{derived::kNewestSession, "newest session"},
            {derived::kEarlierSessions, "earlier: " + std::to_string(sessions - 1)}};
  for (const auto& [count, label] : by_count)
    rows.push_back({draw::colourOfLabel(label), label + ": " + std::to_string(-count)});
  return rows;
}

}  // namespace

draw::Image drawMap(const derived::GridPicture& grid, const std::vector<derived::ShapedLandmark>& landmarks,
                    const std::vector<map::StampedPose>& trajectory, const std::vector<derived::Closure>& closures) {
  draw::Image image(grid.image.width, grid.image.height, kPaper);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = grid.image.palette[grid.image.pixels[i]];
  // Thin lines, so that walls can be seen beside and under them.
  const double width = std::max(1.2, std::max(image.width, image.height) / 900.0);
  drawAreas(image, grid, landmarks, width);
  drawLinesAndPoints(image, grid, landmarks, width);
  for (const derived::Closure& closure : closures) {
    if (!closure.decision->accepted) continue;
    drawLine(image, pixelOf(grid, closure.from), pixelOf(grid, closure.to), {kClosure, width, 0.6});
  }
  const auto paths = simplifiedPaths(grid, trajectory, 0.25);
  drawTracks(image, paths, width);
  drawCaptions(image, grid, landmarks, width);
  derived::drawScaleBar(image, grid);
  constexpr int kColumns = 6,
                kSideOfALetter = 800;  // [px] length of the longer side for which letters grow by 6 by 13 px
  draw::drawLegend(image, legendOf(landmarks, paths.size()), kColumns,
                   std::max(1, std::max(image.width, image.height) / kSideOfALetter));
  return image;
}

std::vector<mrpt::math::TPoint3D> placesOf(const std::vector<map::StampedPose>& trajectory,
                                           const std::vector<derived::ShapedLandmark>& landmarks) {
  std::vector<mrpt::math::TPoint3D> places;
  for (const auto& pose : trajectory) places.push_back(pose.map_from_base.translation());
  const auto add = [&](const derived::PlanPoint& point) { places.emplace_back(point.x(), point.y(), 0); };
  for (const auto& landmark : landmarks) {
    const derived::PlanShape plan = derived::fromAbove(landmark.shape);
    for (const auto& [from, to] : plan.lines) add(from), add(to);
    for (const auto& area : plan.areas) std::for_each(area.begin(), area.end(), add);
    std::for_each(plan.points.begin(), plan.points.end(), add);
  }
  return places;
}

std::optional<derived::GridPicture> emptyPicture(const std::vector<map::StampedPose>& trajectory,
                                                 const std::vector<derived::ShapedLandmark>& landmarks, double margin,
                                                 int side) {
  const auto places = placesOf(trajectory, landmarks);
  if (places.empty()) return std::nullopt;
  double min_x = places.front().x, max_x = min_x, min_y = places.front().y, max_y = min_y;
  for (const auto& place : places) {
    min_x = std::min(min_x, place.x), max_x = std::max(max_x, place.x);
    min_y = std::min(min_y, place.y), max_y = std::max(max_y, place.y);
  }
  const double width = max_x - min_x + 2 * margin, height = max_y - min_y + 2 * margin;
  derived::GridPicture picture;
  picture.metres_per_pixel = std::max(width, height) / side;
  picture.min_x = min_x - margin;
  picture.max_y = max_y + margin;
  picture.image.width = std::max(1, static_cast<int>(std::lround(width / picture.metres_per_pixel)));
  picture.image.height = std::max(1, static_cast<int>(std::lround(height / picture.metres_per_pixel)));
  picture.image.palette = {kPaper};
  picture.image.pixels.assign(static_cast<std::size_t>(picture.image.width) * picture.image.height, 0);
  return picture;
}

std::vector<SessionPath> simplifiedPaths(const derived::GridPicture& grid,
                                         const std::vector<map::StampedPose>& trajectory, double tolerance) {
  std::vector<std::vector<Eigen::Vector2d>> sessions;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (i == 0 || trajectory[i].session != trajectory[i - 1].session) sessions.emplace_back();
    const draw::PixelPoint pixel = pixelOf(grid, trajectory[i].map_from_base.translation());
    sessions.back().emplace_back(pixel.x, pixel.y);
  }
  std::vector<SessionPath> paths;
  for (const auto& session : sessions) {
    auto& path = paths.emplace_back();
    path.is_newest = paths.size() == sessions.size();
    for (const std::size_t i : geometry::keptOfLine(session, tolerance))
      path.points.push_back({session[i].x(), session[i].y()});
  }
  return paths;
}

}  // namespace omnimapper::plugins
