#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/geometry/motionBetween.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "alignBorders.h"

namespace omnimapper::building {

namespace {

using Eigen::Vector2d;
using Loop = std::vector<Vector2d>;
using Pairs = std::vector<std::pair<Vector2d, Vector2d>>;  // then, now

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

}  // namespace

std::optional<geometry::Se2> alignEdits(const RoomEdits& edits, const Storey& now,
                                        const std::map<std::string, Vector2d>& signs) {
  constexpr double kLeastShare = 0.7, kLeastScore = 0.65, kSameFrame = 0.05;
  const auto isHere = [&](const geometry::Se2& motion) {
    return shareInRooms(samplesIn(edits.outlines), motion, now) >= kLeastShare;
  };
  Pairs pairs;
  for (const auto& [text, place] : edits.signs)
    if (const auto found = signs.find(text); found != signs.end()) pairs.emplace_back(place, found->second);
  if (pairs.size() >= 2) {
    const auto motion = geometry::motionBetween(pairs);
    return isHere(motion) ? std::optional(motion) : std::nullopt;
  }
  std::vector<Loop> outlines;
  for (const Room& room : now.rooms) outlines.push_back(room.outline);
  // A map that was continued has the same frame.
  const double same_frame = scoreByBorders(edits.outlines, outlines, {});
  if (same_frame >= 1 - kSameFrame) return geometry::Se2{};
  BorderAlignment best;
  for (const auto& motion : motionsByBorders(edits.outlines, outlines)) {
    const auto refined = refinedByBorders(edits.outlines, outlines, motion);
    if (refined.score > best.score) best = refined;
  }
  if (same_frame >= best.score - kSameFrame) best = {{}, same_frame};
  if (best.score < kLeastScore || !isHere(best.now_from_then)) return std::nullopt;
  return best.now_from_then;
}

}  // namespace omnimapper::building
