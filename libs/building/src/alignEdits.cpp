#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;
using Loop = std::vector<Vector2d>;
using Pairs = std::vector<std::pair<Vector2d, Vector2d>>;  // then, now

// The motion that takes the first points to the second ones with the least squares (Umeyama 1991, in the plane).
geometry::Se2 motionOf(const Pairs& pairs) {
  Vector2d then(0, 0), now(0, 0);
  for (const auto& [a, b] : pairs) then += a / pairs.size(), now += b / pairs.size();
  double cosine = 0, sine = 0;
  for (const auto& [a, b] : pairs) {
    const Vector2d p = a - then, q = b - now;
    cosine += p.dot(q);
    sine += p.x() * q.y() - p.y() * q.x();
  }
  geometry::Se2 motion{0, 0, std::atan2(sine, cosine)};
  const Vector2d shift = now - motion * then;
  return {shift.x(), shift.y(), motion.yaw};
}

Vector2d meanOf(const Loop& loop) {
  // The centre of the area, which does not depend on how the corners are spread.
  Vector2d sum(0, 0);
  double doubled = 0;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const double cross = loop[j].x() * loop[i].y() - loop[i].x() * loop[j].y();
    sum += cross * (loop[i] + loop[j]);
    doubled += cross;
  }
  return std::abs(doubled) > 1e-9 ? Vector2d(sum / (3 * doubled)) : loop.empty() ? sum : loop.front();
}

// Points inside of the outlines, half a metre apart or more.
std::vector<Vector2d> samplesIn(const std::vector<Loop>& outlines) {
  constexpr double kStep = 0.5;
  constexpr std::size_t kMost = 2000;
  std::vector<Vector2d> samples;
  for (const Loop& loop : outlines) {
    if (loop.empty()) continue;
    Room room;
    room.outline = loop;
    Vector2d low = loop.front(), high = low;
    for (const auto& corner : loop) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    const double step = std::max(kStep, (high - low).maxCoeff() / 40);
    for (double x = low.x() + step / 2; x < high.x(); x += step)
      for (double y = low.y() + step / 2; y < high.y() && samples.size() < kMost; y += step)
        if (contains(room, {x, y})) samples.emplace_back(x, y);
  }
  return samples;
}

double shareInRooms(const std::vector<Vector2d>& samples, const geometry::Se2& now_from_then, const Storey& now) {
  if (samples.empty()) return 0;
  const auto inside = std::count_if(samples.begin(), samples.end(), [&](const Vector2d& sample) {
    return roomAt(now, now_from_then * sample) != nullptr;
  });
  return static_cast<double>(inside) / static_cast<double>(samples.size());
}

// The motions for which two rooms of then are two of now with about the same areas and distance.
std::vector<geometry::Se2> motionsByRooms(const std::vector<Loop>& outlines, const Storey& now) {
  constexpr std::size_t kMostRooms = 12;
  constexpr double kArea = 0.2, kDistance = 0.6, kApart = 1.5;  // relative; [m]
  struct Known {
    Vector2d middle;
    double area;
  };
  const auto largest = [&](std::vector<Known> rooms) {
    std::stable_sort(rooms.begin(), rooms.end(), [](const Known& a, const Known& b) { return a.area > b.area; });
    if (rooms.size() > kMostRooms) rooms.resize(kMostRooms);
    return rooms;
  };
  std::vector<Known> then, today;
  for (const Loop& loop : outlines) then.push_back({meanOf(loop), std::abs(geometry::area(loop))});
  for (const Room& room : now.rooms) today.push_back({meanOf(room.outline), std::abs(geometry::area(room.outline))});
  then = largest(std::move(then));
  today = largest(std::move(today));
  const auto isAlike = [&](const Known& a, const Known& b) { return std::abs(a.area - b.area) <= kArea * a.area; };
  std::vector<geometry::Se2> motions;
  for (const auto& a : then)
    for (const auto& b : then)
      for (const auto& p : today)
        for (const auto& q : today) {
          if (&a == &b || &p == &q || !isAlike(a, p) || !isAlike(b, q)) continue;
          const double distance = (a.middle - b.middle).norm();
          if (distance < kApart || std::abs(distance - (p.middle - q.middle).norm()) > kDistance) continue;
          motions.push_back(motionOf({{a.middle, p.middle}, {b.middle, q.middle}}));
        }
  return motions;
}

}  // namespace

std::optional<geometry::Se2> alignEdits(const RoomEdits& edits, const Storey& now,
                                        const std::map<std::string, Vector2d>& signs) {
  constexpr double kLeastShare = 0.7, kSame = 0.9;
  const auto samples = samplesIn(edits.outlines);
  Pairs pairs;
  for (const auto& [text, place] : edits.signs)
    if (const auto found = signs.find(text); found != signs.end()) pairs.emplace_back(place, found->second);
  std::vector<geometry::Se2> motions{geometry::Se2{}};
  if (pairs.size() >= 2) motions = {motionOf(pairs)};
  // A map that was continued has the same frame.
  if (pairs.size() < 2 && shareInRooms(samples, motions.front(), now) < kSame) {
    const auto found = motionsByRooms(edits.outlines, now);
    motions.insert(motions.end(), found.begin(), found.end());
  }
  geometry::Se2 best;
  double most = -1;
  for (const auto& motion : motions) {
    const double share = shareInRooms(samples, motion, now);
    if (share <= most) continue;
    most = share;
    best = motion;
  }
  if (most < kLeastShare) return std::nullopt;
  return best;
}

}  // namespace omnimapper::building
