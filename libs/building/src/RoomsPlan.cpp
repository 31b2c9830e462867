#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomsPlan.h>
#include <omnimapper/building/StraightWalls.h>
#include <omnimapper/draw/Svg.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;
using Loop = std::vector<Vector2d>;

constexpr double kPixels = 40, kMargin = 40;  // [px/m], [px]
constexpr double kOuterWall = 0.2;            // [m] nobody has seen how thick outer walls are
constexpr char kWall[] = "#2a2a2a", kFloor[] = "#ffffff", kSeenInPart[] = "#f4f4f0", kFurniture[] = "#7a7a7a",
               kThing[] = "#f1ece2", kLeaf[] = "#8a4b12", kGlass[] = "#4aa3c7";

/// Where points of the map are on the sheet. The walls of the storey are turned so that they are level and upright.
class Sheet {
 public:
  Sheet(const std::vector<Loop>& outlines, double direction) : turn_(-direction) {
    for (const Loop& outline : outlines)
      for (const auto& corner : outline) box_.extend(turn_ * corner);
    if (box_.isEmpty()) box_ = {Vector2d(0, 0), Vector2d(1, 1)};
  }
  Vector2d at(const Vector2d& point) const {
    const Vector2d turned = turn_ * point;
    return {kMargin + kPixels * (turned.x() - box_.min().x()), kMargin + kPixels * (box_.max().y() - turned.y())};
  }
  Loop at(const Loop& loop) const {
    Loop all;
    for (const auto& corner : loop) all.push_back(at(corner));
    return all;
  }
  Vector2d size() const { return kPixels * box_.sizes() + Vector2d(2 * kMargin, 3 * kMargin); }

 private:
  Eigen::Rotation2Dd turn_;
  Eigen::AlignedBox2d box_;
};

Loop band(const geometry::Segment2& segment, double thickness) {
  const Vector2d along = geometry::direction(segment), across = Vector2d(-along.y(), along.x()) * thickness / 2;
  return {segment.from - across, segment.to - across, segment.to + across, segment.from + across};
}

void drawWalls(const Storey& storey, const std::vector<Loop>& outlines, const Sheet& sheet, draw::Svg& svg) {
  for (const Loop& outline : outlines) svg.polygon(sheet.at(outline), kWall, kWall, 2 * kOuterWall * kPixels);
  for (std::size_t i = 0; i < outlines.size(); ++i)
    svg.polygon(sheet.at(outlines[i]), storey.rooms[i].isOpen() ? kSeenInPart : kFloor, "none", 0);
}

void drawPassages(const Storey& storey, const Sheet& sheet, draw::Svg& svg) {
  constexpr double kThrough = 0.7;  // [m] more than the thickness of a wall
  for (const Door& door : storey.doors) svg.polygon(sheet.at(band(door.opening, kThrough)), kFloor, "none", 0);
  for (const Door& door : storey.doors)
    for (const Vector2d& end : {door.opening.from, door.opening.to}) {
      const Vector2d along = geometry::direction(door.opening), across(-along.y(), along.x());
      svg.line(sheet.at(end - 0.1 * across), sheet.at(end + 0.1 * across), kWall, 2);
    }
}

/// A leaf with the side at which it hangs.
struct Hinge {
  Vector2d hinge, tip, latch;  ///< `latch`: where the tip is when the door is closed
};

// The leaf in the passage beside which it hangs; none if it is at no passage.
std::optional<Hinge> hingeOf(const geometry::Segment2& leaf, const Storey& storey) {
  constexpr double kNear = 0.35;  // [m]
  std::optional<Hinge> best;
  double least = kNear;
  for (const Door& door : storey.doors)
    for (const auto& [end, latch] :
         {std::pair(door.opening.from, door.opening.to), std::pair(door.opening.to, door.opening.from)})
      for (const auto& [hinge, tip] : {std::pair(leaf.from, leaf.to), std::pair(leaf.to, leaf.from)})
        if (const double distance = (end - hinge).norm(); distance < least) {
          least = distance;
          best = Hinge{end, end + (tip - hinge), latch};
        }
  return best;
}

void drawSwing(const Hinge& leaf, const Sheet& sheet, draw::Svg& svg) {
  constexpr int kSteps = 16;
  const Vector2d open = leaf.tip - leaf.hinge, closed = leaf.latch - leaf.hinge;
  const double begin = std::atan2(open.y(), open.x());
  const double turn = std::remainder(std::atan2(closed.y(), closed.x()) - begin, 2 * M_PI);
  Loop arc;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = begin + turn * i / kSteps;
    arc.push_back(sheet.at(Vector2d(leaf.hinge + open.norm() * Vector2d(std::cos(angle), std::sin(angle)))));
  }
  svg.polyline(arc, kLeaf, 1);
  svg.line(sheet.at(leaf.hinge), sheet.at(leaf.tip), kLeaf, 3);
}

void drawLeaves(const Storey& storey, const PlanContents& contents, const Sheet& sheet, draw::Svg& svg) {
  for (const auto& leaf : contents.leaves) {
    if (const auto hinge = hingeOf(leaf, storey)) {
      drawSwing(*hinge, sheet, svg);
    } else {
      svg.polygon(sheet.at(band(leaf, 0.25)), kFloor, kLeaf, 1);
      svg.line(sheet.at(leaf.from), sheet.at(leaf.to), kLeaf, 3);
    }
  }
  for (const auto& window : contents.windows) svg.polygon(sheet.at(band(window, 0.2)), kFloor, kGlass, 1.5);
}

void drawThings(const PlanContents& contents, const Sheet& sheet, draw::Svg& svg) {
  constexpr double kNamed = 0.55;  // [m] a thing that is narrower has no room for its name
  for (const auto& thing : contents.things) svg.polygon(sheet.at(thing.corners), kThing, kFurniture, 1);
  for (const auto& thing : contents.things) {
    Eigen::AlignedBox2d box;
    for (const auto& corner : sheet.at(thing.corners)) box.extend(corner);
    if (box.isEmpty() || box.sizes().y() < kNamed * kPixels || box.sizes().x() < kNamed * kPixels) continue;
    svg.text(box.center() + Vector2d(0, 4), thing.name, draw::Svg::Anchor::middle, 10);
  }
}

void drawNames(const Storey& storey, const Sheet& sheet, draw::Svg& svg) {
  for (const Room& room : storey.rooms) {
    const Vector2d at = sheet.at(room.centre), line(0, 16);
    svg.text(at, labelOf(room), draw::Svg::Anchor::middle, 16);
    svg.text(at + line, base::fixed(room.area, 1) + " m\u00b2" + (room.isOpen() ? ", seen in part" : ""),
             draw::Svg::Anchor::middle);
  }
}

void drawScale(const Sheet& sheet, draw::Svg& svg) {
  constexpr int kLength = 5;  // [m]
  const double y = sheet.size().y() - kMargin;
  for (int metre = 0; metre < kLength; ++metre)
    svg.polygon({{kMargin + metre * kPixels, y},
                 {kMargin + (metre + 1) * kPixels, y},
                 {kMargin + (metre + 1) * kPixels, y + 5},
                 {kMargin + metre * kPixels, y + 5}},
                metre % 2 == 0 ? kWall : kFloor, kWall, 1);
  svg.text({kMargin + kLength * kPixels + 8, y + 7}, std::to_string(kLength) + " m", draw::Svg::Anchor::start);
}

}  // namespace

std::string encodePlan(const Storey& storey, const PlanContents& contents) {
  std::ostringstream out;
  const auto outlines = straightOutlines(storey);
  const Sheet sheet(outlines, directionOfWalls(storey));
  {
    draw::Svg svg(out, sheet.size().x(), sheet.size().y());
    drawWalls(storey, outlines, sheet, svg);
    drawPassages(storey, sheet, svg);
    drawThings(contents, sheet, svg);
    drawLeaves(storey, contents, sheet, svg);
    drawNames(storey, sheet, svg);
    drawScale(sheet, svg);
  }
  return out.str();
}

}  // namespace omnimapper::building
