#include <omnimapper/building/StraightWalls.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;
using Loop = std::vector<Vector2d>;

/// A side of an outline that runs along an axis: 0 for x, 1 for y.
struct Side {
  int axis = 0;
  double at = 0;      ///< coordinate on the other axis [m]
  double weight = 0;  ///< [m] of the outline that it stands for
};

/// A closed outline whose sides run along x and y in turn.
class RightAngled {
 public:
  explicit RightAngled(const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d from = loop[i], to = loop[(i + 1) % loop.size()], step = to - from;
      const int axis = std::abs(step.x()) >= std::abs(step.y()) ? 0 : 1;
      sides_.push_back({axis, (from[1 - axis] + to[1 - axis]) / 2, step.norm()});
    }
    joinEqualAxes();
  }

  bool isOne() const { return sides_.size() >= 4; }
  std::size_t size() const { return sides_.size(); }
  const Side& side(std::ptrdiff_t i) const { return sides_[index(i)]; }

  /// Where side i begins.
  Vector2d corner(std::ptrdiff_t i) const {
    const Side &before = side(i - 1), &after = side(i);
    return after.axis == 0 ? Vector2d(before.at, after.at) : Vector2d(after.at, before.at);
  }
  /// From the begin of side i to its end, with its sign along the axis.
  double step(std::ptrdiff_t i) const { return (corner(i + 1) - corner(i))[side(i).axis]; }
  /// Whether the outline turns to the left at the begin of side i.
  bool turnsLeft(std::ptrdiff_t i) const {
    const Vector2d in = corner(i) - corner(i - 1), out = corner(i + 1) - corner(i);
    return in.x() * out.y() - in.y() * out.x() > 0;
  }
  /// Takes out side i; the two sides that it joined become one, at that coordinate.
  void takeOut(std::ptrdiff_t i, double at) {
    sides_[index(i - 1)] = {side(i - 1).axis, at, side(i - 1).weight + side(i + 1).weight};
    const std::size_t first = index(i), second = index(i + 1);
    sides_.erase(sides_.begin() + static_cast<std::ptrdiff_t>(std::max(first, second)));
    sides_.erase(sides_.begin() + static_cast<std::ptrdiff_t>(std::min(first, second)));
  }
  Loop loop() const {
    Loop result;
    for (std::size_t i = 0; i < size(); ++i) result.push_back(corner(static_cast<std::ptrdiff_t>(i)));
    return result;
  }

 private:
  std::size_t index(std::ptrdiff_t i) const {
    const auto count = static_cast<std::ptrdiff_t>(sides_.size());
    return static_cast<std::size_t>(((i % count) + count) % count);
  }
  void joinEqualAxes() {
    std::vector<Side> joined;
    const auto add = [](Side& a, const Side& b) {
      const double weight = a.weight + b.weight;
      if (weight > 0) a.at = (a.at * a.weight + b.at * b.weight) / weight;
      a.weight = weight;
    };
    for (const Side& side : sides_) {
      if (!joined.empty() && joined.back().axis == side.axis) {
        add(joined.back(), side);
      } else {
        joined.push_back(side);
      }
    }
    if (joined.size() > 1 && joined.front().axis == joined.back().axis) {
      add(joined.front(), joined.back());
      joined.pop_back();
    }
    sides_ = std::move(joined);
  }

  std::vector<Side> sides_;
};

bool isDoorAt(const std::vector<geometry::Segment2>& doors, const Eigen::AlignedBox2d& box) {
  constexpr double kNear = 0.2;  // [m]
  return std::any_of(doors.begin(), doors.end(), [&](const geometry::Segment2& door) {
    return box.exteriorDistance(Vector2d(geometry::middle(door))) < kNear;
  });
}

/// A change of an outline: side `side` is taken out, and the sides beside it lie at `at`.
struct Change {
  std::ptrdiff_t side = 0;
  double at = 0;
  double area = 0;  ///< [m^2] that the outline gains or loses
};

class Straightening {
 public:
  Straightening(const std::vector<geometry::Segment2>& doors, const StraightWallOptions& options)
      : doors_(&doors), options_(&options) {}

  /// The smallest change that makes the outline straighter; none if there is none.
  std::optional<Change> next(const RightAngled& outline) const {
    std::optional<Change> best;
    const auto count = static_cast<std::ptrdiff_t>(outline.size());
    for (std::ptrdiff_t i = 0; outline.size() > 4 && i < count; ++i)
      if (const auto change = changeAt(outline, i); change && (!best || change->area < best->area)) best = change;
    return best;
  }

 private:
  // A change that takes out side i: a small step, or one end of a dent.
  std::optional<Change> changeAt(const RightAngled& outline, std::ptrdiff_t i) const {
    const double depth = std::abs(outline.step(i));
    const auto before = outline.side(i - 1), after = outline.side(i + 1);
    const double shorter = std::min(std::abs(outline.step(i - 1)), std::abs(outline.step(i + 1)));
    constexpr double kNone = 1e-6;  // [m] a shorter step has no direction
    const bool is_step = depth < kNone || outline.turnsLeft(i) != outline.turnsLeft(i + 1);
    if (!is_step) return std::nullopt;
    if (depth <= options_->jog) {
      const double weight = before.weight + after.weight;
      return Change{i, weight > 0 ? (before.at * before.weight + after.at * after.weight) / weight : before.at,
                    depth * shorter};
    }
    return dentAt(outline, i, depth);
  }

  // Whether sides in line with a side make up most of that wall, as beside a bay.
  bool isWall(const RightAngled& outline, std::ptrdiff_t i) const {
    constexpr double kMost = 0.6;
    const Side& side = outline.side(i);
    double in_line = 0;
    Eigen::AlignedBox2d box;
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(outline.size()); ++k) {
      box.extend(outline.corner(k));
      const Side& other = outline.side(k);
      if (other.axis == side.axis && std::abs(other.at - side.at) <= options_->jog)
        in_line += std::abs(outline.step(k));
    }
    return in_line >= kMost * box.sizes()[side.axis];
  }

  // The outline turns to the right where furniture stands in the room. The side of the dent is moved outwards, to that
  // of the wall that it meets by side i.
  std::optional<Change> dentAt(const RightAngled& outline, std::ptrdiff_t i, double depth) const {
    const bool is_after = outline.turnsLeft(i);  // left, then right: the dent is after side i
    const std::ptrdiff_t dent = is_after ? i + 1 : i - 1, wall = is_after ? i - 1 : i + 1;
    const double width = std::abs(outline.step(dent));
    const std::ptrdiff_t far = is_after ? dent + 1 : dent - 1;  // the other end of the dent
    const bool ends_at_wall = is_after ? outline.turnsLeft(far) : outline.turnsLeft(far + 1);
    const bool comes_back = !ends_at_wall && std::abs(outline.step(far)) >= depth - options_->jog;
    const double area = depth * width;
    if (depth > options_->dent && width > options_->dent) return std::nullopt;
    const bool is_corner = ends_at_wall && area <= options_->corner_area;
    if (!comes_back && (!is_corner || isWall(outline, dent) || isWall(outline, i))) return std::nullopt;
    if (comes_back && depth > options_->dent) return std::nullopt;
    Eigen::AlignedBox2d box;
    box.extend(outline.corner(dent)).extend(outline.corner(dent + 1));
    Vector2d back = outline.corner(dent);
    back[1 - outline.side(dent).axis] = outline.side(wall).at;
    box.extend(back);
    if (isDoorAt(*doors_, box)) return std::nullopt;
    return Change{i, outline.side(wall).at, area};
  }

  const std::vector<geometry::Segment2>* doors_;
  const StraightWallOptions* options_;
};

// Share of an outline's length that runs along x or y, up to 15 deg.
double shareAlongAxes(const Loop& loop) {
  constexpr double kAlong = 0.259;  // sine of 15 deg
  double along = 0, whole = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2d step = loop[(i + 1) % loop.size()] - loop[i];
    whole += step.norm();
    if (step.cwiseAbs().minCoeff() <= kAlong * step.norm()) along += step.norm();
  }
  return whole > 0 ? along / whole : 0;
}

std::vector<geometry::Segment2> doorsOf(const Room& room, const Storey& storey, const Eigen::Rotation2Dd& turn) {
  std::vector<geometry::Segment2> doors;
  for (const Door& door : storey.doors)
    if (door.rooms[0] == room.id || door.rooms[1] == room.id)
      doors.push_back({turn * door.opening.from, turn * door.opening.to});
  return doors;
}

}  // namespace

double directionOfWalls(const Storey& storey) {
  std::complex<double> sum = 0;
  for (const Room& room : storey.rooms) {
    for (std::size_t i = 0; i < room.outline.size(); ++i) {
      const Vector2d step = room.outline[(i + 1) % room.outline.size()] - room.outline[i];
      // Long sides count more: short ones are those of furniture and of the raster.
      sum += std::polar(step.squaredNorm(), 4 * std::atan2(step.y(), step.x()));
    }
  }
  return std::abs(sum) > 0 ? std::arg(sum) / 4 : 0;
}

std::vector<Loop> straightOutlines(const Storey& storey, const StraightWallOptions& options) {
  const Eigen::Rotation2Dd map_from_walls(directionOfWalls(storey)), walls_from_map = map_from_walls.inverse();
  std::vector<Loop> outlines;
  for (const Room& room : storey.rooms) {
    Loop turned;
    for (const auto& corner : room.outline) turned.push_back(walls_from_map * corner);
    RightAngled outline(turned);
    outlines.push_back(room.outline);
    if (!outline.isOne() || shareAlongAxes(turned) < options.straightness) continue;
    const auto doors = doorsOf(room, storey, walls_from_map);
    const Straightening straightening(doors, options);
    while (const auto change = straightening.next(outline)) outline.takeOut(change->side, change->at);
    Loop straight;
    for (const auto& corner : outline.loop()) straight.push_back(map_from_walls * corner);
    if (geometry::area(straight) > 0) outlines.back() = std::move(straight);
  }
  return outlines;
}

}  // namespace omnimapper::building
