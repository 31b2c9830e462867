#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomsPlan.h>
#include <omnimapper/draw/Svg.h>

#include <algorithm>
#include <sstream>

namespace omnimapper::building {

namespace {

constexpr double kPixels = 40, kMargin = 30;  // [px/m], [px]

struct Sheet {
  Eigen::Vector2d low{0, 0}, high{1, 1};  // [m]

  explicit Sheet(const Storey& storey) {
    bool is_first = true;
    for (const Room& room : storey.rooms) {
      for (const auto& corner : room.outline) {
        low = is_first ? corner : Eigen::Vector2d(low.cwiseMin(corner));
        high = is_first ? corner : Eigen::Vector2d(high.cwiseMax(corner));
        is_first = false;
      }
    }
  }
  Eigen::Vector2d at(const Eigen::Vector2d& point) const {
    return {kMargin + kPixels * (point.x() - low.x()), kMargin + kPixels * (high.y() - point.y())};
  }
  Eigen::Vector2d size() const { return kPixels * (high - low) + Eigen::Vector2d(2 * kMargin, 3 * kMargin); }
};

void drawLoop(draw::Svg& svg, const Sheet& sheet, const std::vector<Eigen::Vector2d>& loop) {
  if (loop.empty()) return;
  std::vector<Eigen::Vector2d> points;
  for (const auto& corner : loop) points.push_back(sheet.at(corner));
  points.push_back(points.front());
  svg.polyline(points, "#202020", 4);
}

void drawScale(draw::Svg& svg, const Sheet& sheet) {
  constexpr double kLength = 5;  // [m]
  const double y = sheet.size().y() - kMargin;
  svg.line({kMargin, y}, {kMargin + kLength * kPixels, y}, "#202020", 2);
  svg.text({kMargin + kLength * kPixels + 8, y + 4}, base::brief(kLength) + " m", draw::Svg::Anchor::start);
}

}  // namespace

std::string encodePlan(const Storey& storey) {
  std::ostringstream out;
  const Sheet sheet(storey);
  {
    draw::Svg svg(out, sheet.size().x(), sheet.size().y());
    svg.box({0, 0}, sheet.size(), "#ffffff");
    for (const Room& room : storey.rooms) {
      drawLoop(svg, sheet, room.outline);
      for (const auto& hole : room.holes) drawLoop(svg, sheet, hole);
    }
    for (const Door& door : storey.doors) {
      svg.line(sheet.at(door.opening.from), sheet.at(door.opening.to), "#ffffff", 8);
      svg.line(sheet.at(door.opening.from), sheet.at(door.opening.to), "#c04040", 1);
    }
    for (const Room& room : storey.rooms) {
      const Eigen::Vector2d at = sheet.at(room.centre), line(0, 16);
      svg.text(at, labelOf(room), draw::Svg::Anchor::middle, 16);
      svg.text(at + line, base::fixed(room.area, 1) + " m2" + (room.isOpen() ? ", open" : ""),
               draw::Svg::Anchor::middle);
    }
    drawScale(svg, sheet);
  }
  return out.str();
}

}  // namespace omnimapper::building
