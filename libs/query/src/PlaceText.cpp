#include "PlaceText.h"

#include <mrpt/system/datetime.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "Letters.h"

namespace omnimapper::query {

namespace {

using base::fixed;

constexpr std::size_t kLongestName = 40;  // characters

std::string positionText(const Eigen::Vector3d& at) {
  return fixed(at.x(), 2) + " " + fixed(at.y(), 2) + " " + fixed(at.z(), 2);
}

// Sides of the smallest rectangle around the points, which has a side along their convex hull; the longer one first.
Eigen::Vector2d leastSides(const std::vector<Eigen::Vector2d>& points) {
  const auto hull = geometry::convexHull(points);
  Eigen::Vector2d best(0, 0);
  double least = HUGE_VAL;
  for (std::size_t i = 0; hull.size() > 1 && i < hull.size(); ++i) {
    const Eigen::Vector2d along = (hull[(i + 1) % hull.size()] - hull[i]).normalized(), across(-along.y(), along.x());
    Eigen::AlignedBox2d box;
    for (const auto& corner : hull) box.extend(Eigen::Vector2d(along.dot(corner), across.dot(corner)));
    if (box.volume() >= least) continue;
    least = box.volume();
    best = {box.sizes().maxCoeff(), box.sizes().minCoeff()};
  }
  return best;
}

std::string extentText(const map::Place& place) {
  const map::Extent& extent = place.extent;
  std::vector<Eigen::Vector2d> all = extent.points;
  for (const auto& [from, to] : extent.lines) all.insert(all.end(), {from, to});
  for (const auto& outline : extent.outlines) all.insert(all.end(), outline.begin(), outline.end());
  const Eigen::Vector2d sides = leastSides(all);
  const std::string heights =
      "z " + fixed(extent.bottom, 2) + (extent.top - extent.bottom < 0.01 ? "" : " to " + fixed(extent.top, 2));
  if (!extent.outlines.empty()) return fixed(sides.x(), 1) + " x " + fixed(sides.y(), 1) + " m, " + heights;
  if (!extent.lines.empty()) return fixed(sides.x(), 1) + " m long, " + heights;
  return extent.points.size() > 1 ? base::counted(extent.points.size(), "point") : "point";
}

std::string sureText(const map::Place& place) {
  if (!place.sigma) return "";
  return fixed(*place.sigma, 3) + (place.sigma_is_along_normal ? " across" : "");
}

std::string seenText(const map::Place& place) {
  std::string text = std::to_string(place.measurements) + " x";
  for (const auto& [label, count] : place.seen_by)
    text += (text.back() == 'x' ? " " : ", ") + shownName(label.empty() ? "no label" : label) +
            (place.seen_by.size() > 1 ? " " + std::to_string(count) : "");
  return text;
}

}  // namespace

std::string shownName(const std::string& name) {
  const std::string shown = base::printable(name.substr(0, 4 * kLongestName));
  if (charactersOf(shown).size() <= kLongestName) return shown;
  std::size_t end = 0;
  for (std::size_t count = 0; end < shown.size(); ++end) {
    const bool begins = (static_cast<unsigned char>(shown[end]) & 0xc0) != 0x80;
    if (begins && count++ == kLongestName) break;
  }
  return shown.substr(0, end) + "...";
}

std::string pointText(const Eigen::Vector2d& point) {
  return fixed(point.x(), 2) + " " + fixed(point.y(), 2);
}

std::string titleOf(const map::Place& place) {
  return shownName(place.label) + (place.caption.empty() ? "" : " \"" + shownName(place.caption) + "\"");
}

std::string alignedTable(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (std::size_t column = 0; column < widths.size(); ++column) {
    bool has_text = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      has_text = has_text || (i > 0 && !lines[i][column].empty());
      widths[column] = std::max(widths[column], charactersOf(lines[i][column]).size());
    }
    if (!has_text) widths[column] = 0;
  }
  std::string text;
  for (const auto& line : lines) {
    std::string row = " ";
    for (std::size_t column = 0; column < widths.size(); ++column) {
      if (widths[column] == 0) continue;
      row += " " + line[column] + std::string(widths[column] - charactersOf(line[column]).size() + 1, ' ');
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

std::vector<std::string> placeHeads() {
  return {"name", "id", "x y z [m]", "extent", "sigma [m]", "seen", "last seen (UTC)", "state"};
}

std::vector<std::string> cellsOf(const map::Place& place) {
  return {titleOf(place),  toString(place.id), positionText(place.position), extentText(place),
          sureText(place), seenText(place),    timeText(place.last_seen),    place.moved ? "moved away" : ""};
}

std::string timeText(base::Stamp stamp) {
  if (!base::isValid(stamp)) return "";
  mrpt::system::TTimeParts parts;
  mrpt::system::timestampToParts(stamp, parts);
  char text[80];
  std::snprintf(text, sizeof text, "%04d-%02d-%02d %02d:%02d:%02d", parts.year, parts.month, parts.day, parts.hour,
                parts.minute, static_cast<int>(parts.second));
  return text;
}

}  // namespace omnimapper::query
