#include <omnimapper/matching/MovingThings.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

// doc/results/robustness.md has the logs on which these were chosen.
constexpr float kThingReach = 0.35F,
                kThingReachPerSecond = 1;  // [m] [m/s] from where a thing is expected to where it is found
constexpr double kOutOfView = 2;           // [s] after which a thing that is out of view is forgotten
constexpr float kBeside = 0.5F;            // [m] from a thing that moves, within which the other leg may be
constexpr int kSuspected = 2;              // scans in a row
constexpr double kYoung = 1;               // [s] for which a new thing may be that leg
constexpr float kGrown = 0.25F;              // [m] to what may be another thing
constexpr float kPassedBy = 0.2F;          // [m] by which a beam must have passed

constexpr float kOverlapping = 0.1F;       // [m] between points that may be the same
constexpr double kAnchored = 3;            // [s] for which the place of a thing that stands is kept
constexpr float kAnchoredFor = 1;  // [m] of motion of the laser, after which other sides of the thing are in view
constexpr double kBetweenLooks = 0.3, kOldLook = 8, kFreshLook = 0.4;  // [s]
constexpr float kWidthPerRange = 0.035F;  // two degrees: the beams cannot miss a thing that is wider
constexpr std::size_t kSampled = 8;       // points of a thing that are looked at

float widthOfThing(const std::vector<Eigen::Vector2f>& points) {
  Eigen::Array2f low = points.front(), high = low;
  for (const auto& point : points) {
    low = low.min(point.array());
    high = high.max(point.array());
  }
  return (high - low).matrix().norm();
}

struct LookCounts {
  int free = 0, occupied = 0, all = 0;
};

LookCounts lookAt(const ScanView& view, const std::vector<Eigen::Vector2f>& points, float margin) {
  LookCounts counts;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSampled);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const auto seen = view.at(points[i], margin);
    counts.free += seen == ScanView::Seen::free;
    counts.occupied += seen == ScanView::Seen::occupied;
    ++counts.all;
  }
  return counts;
}

// Number of points that lie on other points.
std::size_t overlapping(const std::vector<Eigen::Vector2f>& points, const std::vector<Eigen::Vector2f>& others) {
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Eigen::Vector2f& point) {
    return std::any_of(others.begin(), others.end(), [&](const Eigen::Vector2f& other) {
      return (point - other).squaredNorm() < kOverlapping * kOverlapping;
    });
  }));
}

bool isWideFor(const ScanView& view, const std::vector<Eigen::Vector2f>& points, const Eigen::Vector2f& centre) {
  return widthOfThing(points) > kWidthPerRange * view.distance(centre);
}

}  // namespace

std::vector<MovingThings::Sighting> MovingThings::sightings(const TPose2D& track_from_scan, double seconds,
                                                            const ScanWithNormals& scan) {
  const auto c = static_cast<float>(std::cos(track_from_scan.phi)),
             s = static_cast<float>(std::sin(track_from_scan.phi));
  const auto tx = static_cast<float>(track_from_scan.x), ty = static_cast<float>(track_from_scan.y);
  std::vector<Sighting> all;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.things[i] == ScanWithNormals::kNoThing) continue;
    if (i == 0 || scan.things[i] != scan.things[i - 1])
      all.push_back({Eigen::Vector2f::Zero(), {}, seconds, i, Eigen::Vector2f::Zero()});
    const auto& p = scan.points[i];
    all.back().points.emplace_back(tx + c * p.x() - s * p.y(), ty + s * p.x() + c * p.y());
  }
  for (auto& sighting : all) {
    for (const auto& point : sighting.points) sighting.centre += point;
    sighting.centre /= static_cast<float>(sighting.points.size());
  }
  return all;
}

// The known thing that each sighting is of, or null. The nearest pairs are taken first.
std::vector<const MovingThings::Thing*> MovingThings::associated(const std::vector<Sighting>& sightings,
                                                                 double seconds) const {
  struct Pair {
    float distance;
    std::size_t sighting, thing;
  };
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < things_.size(); ++k) {
    const auto passed = static_cast<float>(std::max(0.0, seconds - things_[k].last.seconds));
    const Eigen::Vector2f expected = things_[k].last.centre + passed * things_[k].velocity;
    const float reach = kThingReach + kThingReachPerSecond * std::min(1.0F, passed);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const float distance = (sightings[i].centre - expected).norm();
      if (distance < reach) pairs.push_back({distance, i, k});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  std::vector<const Thing*> found(sightings.size(), nullptr);
  std::vector<bool> taken(things_.size(), false);
  for (const auto& pair : pairs) {
    if (found[pair.sighting] || taken[pair.thing]) continue;
    found[pair.sighting] = &things_[pair.thing];
    taken[pair.thing] = true;
  }
  return found;
}

// Of a thing that moves, the points whose places were not occupied before it came.
std::vector<bool> MovingThings::movingPoints(const Thing& thing, const Sighting& now) const {
  constexpr float kCame = 0.5F;    // [m] from its place, at least, before it came
  constexpr float kClose = 0.08F;  // [m] from the end of a beam, within which a place is occupied
  std::vector<bool> moving(now.points.size(), true);
  const auto came = std::find_if(thing.trail.rbegin(), thing.trail.rend(), [&](const Passed& passed) {
    return (passed.centre - now.centre).norm() > kCame;
  });
  if (came == thing.trail.rend()) return moving;
  for (std::size_t i = 0; i < now.points.size(); ++i) {
    int free = 0, occupied = 0;
    for (const auto& look : looks_) {
      if (look.seconds > came->seconds) break;
      free += look.view.at(now.points[i], kClose) == ScanView::Seen::free;
      occupied += look.view.at(now.points[i], kClose) == ScanView::Seen::occupied;
    }
    moving[i] = occupied < 2 || occupied <= 2 * free;
  }
  return moving;
}

// Marks the points of a thing that move. What goes nowhere, or only where something was before, does not move: other
// sides of a chair have come into view, or somebody who walked past it has passed their name on to it.
void MovingThings::reconsider(const Sighting& now, Thing& thing) {
  constexpr double kWhile = 1, kStart = 2;  // [s]
  constexpr float kGone = 0.25F;               // [m]
  const auto moving = movingPoints(thing, now);
  const auto count = static_cast<std::size_t>(std::count(moving.begin(), moving.end(), true));
  if (10 * count > 3 * moving.size()) thing.last_moved = now.seconds;
  thing.has_gone = thing.has_gone || (now.centre - thing.recognized.centre).norm() > kGone;
  const bool goes_nowhere = !thing.has_gone && now.seconds - thing.recognized.seconds > kStart;
  if (goes_nowhere || now.seconds - thing.last_moved > kWhile) {
    thing.moves = false;
    thing.stands = true;
    thing.is_doubted = true;
    thing.velocity.setZero();
    thing.anchor = now;
    return;
  }
  std::copy(moving.begin(), moving.end(), moving_.begin() + static_cast<std::ptrdiff_t>(now.begin));
}

// Marks points of walls that are where a thing that moves is expected and where earlier beams passed freely: a leg that
// is so near a wall that no gap shows between them.
void MovingThings::markMerged(const TPose2D& track_from_scan, double seconds, const ScanWithNormals& scan,
                              const std::vector<const Thing*>& known, std::vector<bool>& moves) const {
  constexpr float kNear = 0.3F, kPassed = 0.1F;
  const auto c = static_cast<float>(std::cos(track_from_scan.phi)),
             s = static_cast<float>(std::sin(track_from_scan.phi));
  for (const auto& thing : things_) {
    const double passed = seconds - thing.last.seconds;
    if (!thing.moves || passed > kYoung || std::find(known.begin(), known.end(), &thing) != known.end()) continue;
    const Eigen::Vector2f expected = thing.last.centre + static_cast<float>(passed) * thing.velocity;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (scan.things[i] != ScanWithNormals::kNoThing) continue;
      const auto& p = scan.points[i];
      const Eigen::Vector2f place(static_cast<float>(track_from_scan.x) + c * p.x() - s * p.y(),
                                  static_cast<float>(track_from_scan.y) + s * p.x() + c * p.y());
      if ((place - expected).norm() > kNear) continue;
      int free = 0, occupied = 0;
      for (const auto& look : looks_) {
        if (seconds - look.seconds < kFreshLook) break;
        free += look.view.at(place, kPassed) == ScanView::Seen::free;
        occupied += look.view.at(place, kPassed) == ScanView::Seen::occupied;
      }
      if (free >= 2 && free > 2 * occupied) moves[i] = true;
    }
  }
}

bool MovingThings::isBesideMoving(const Sighting& sighting) const {
  return std::any_of(things_.begin(), things_.end(), [&](const Thing& thing) {
    return thing.moves && sighting.seconds - thing.last.seconds < kYoung &&
           (thing.last.centre - sighting.centre).norm() < kBeside;
  });
}

bool MovingThings::standsWhereItWasFree(const Sighting& sighting, float margin) const {
  int free = 0, occupied = 0;
  for (const auto& look : looks_) {
    if (sighting.seconds - look.seconds < kFreshLook || !isWideFor(look.view, sighting.points, sighting.centre))
      continue;
    const auto counts = lookAt(look.view, sighting.points, margin);
    free += 10 * counts.free >= 7 * counts.all;
    occupied += 10 * counts.occupied >= 3 * counts.all;
  }
  return free >= 2 && free > 2 * occupied;
}

bool MovingThings::hasLeftItsPlace(const Thing& thing, const Sighting& now, const ScanView& view, float margin) {
  const auto& before = thing.anchor;
  if ((now.centre - before.centre).norm() < 1.5F * margin || !isWideFor(view, before.points, before.centre)) return false;
  if (5 * overlapping(now.points, before.points) > now.points.size()) return false;
  const auto counts = lookAt(view, before.points, margin);
  return 10 * counts.free >= 7 * counts.all;
}

// A thing stands if its points stay where they are while the laser moves on; then it was a mistake to say that it
// moves, as of a chair beside somebody who walked by. It is no longer sure to stand once its points are elsewhere.
void MovingThings::confirm(const ScanView& view, const Sighting& now, Thing& thing) {
  constexpr float kMovedOn = 0.5F;  // [m] of the laser
  const auto overlaps = overlapping(now.points, thing.anchor.points);
  if (5 * overlaps < now.points.size()) {
    thing.stands = false;
  } else if (2 * overlaps > now.points.size() && (view.origin() - thing.first_viewer).norm() > kMovedOn) {
    thing.stands = true;
    thing.moves = false;
    thing.velocity.setZero();
  }
}

// Whether more walls than doors explain stand where earlier beams passed freely.
bool MovingThings::isPoseWrong(const TPose2D& track_from_scan, const ScanWithNormals& scan) const {
  constexpr std::size_t kMostLooked = 60;
  constexpr int kFewWalls = 10;
  const auto c = static_cast<float>(std::cos(track_from_scan.phi)),
             s = static_cast<float>(std::sin(track_from_scan.phi));
  const std::size_t step = std::max<std::size_t>(1, scan.size() / kMostLooked);
  int walls = 0, wrong = 0;
  for (std::size_t i = 0; i < scan.size(); i += step) {
    if (scan.things[i] != ScanWithNormals::kNoThing || scan.normals[i].squaredNorm() < 0.5F) continue;
    const auto& p = scan.points[i];
    const Eigen::Vector2f place(static_cast<float>(track_from_scan.x) + c * p.x() - s * p.y(),
                                static_cast<float>(track_from_scan.y) + s * p.x() + c * p.y());
    int free = 0, occupied = 0;
    for (const auto& look : looks_) {
      const auto seen = look.view.at(place, kPassedBy);
      free += seen == ScanView::Seen::free;
      occupied += seen == ScanView::Seen::occupied;
    }
    ++walls;
    wrong += free >= 2 && free > 2 * occupied;
  }
  return walls >= kFewWalls && 10 * wrong > walls;
}

void MovingThings::look(const ScanView& view, double seconds) {
  if (!looks_.empty() && seconds - looks_.back().seconds < kBetweenLooks) return;
  looks_.push_back({view, seconds});
  while (seconds - looks_.front().seconds > kOldLook) looks_.pop_front();
}

MovingThings::Expected MovingThings::expected(const TPose2D& track_from_scan, double seconds,
                                              const ScanWithNormals& scan) const {
  // A thing that may move determines a position to kUnsure in kAlike, within which its errors are the same.
  constexpr double kPoint = 0.02, kUnsure = 0.05, kAlike = 2;  // [m] [m] [s]
  const double part = std::clamp((seconds - last_seconds_) / kAlike, 0.0, 1.0);
  const auto unsure = static_cast<float>(kPoint * kPoint / (kUnsure * kUnsure) * part);
  const auto seen = sightings(track_from_scan, seconds, scan);
  const auto known = associated(seen, seconds);
  Expected all{std::vector<bool>(scan.size(), false), std::vector<float>(scan.size(), 1)};
  std::vector<bool> is_unsure(scan.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool stands = known[i] && known[i]->stands;
    const auto count = seen[i].points.size();
    const auto begin = static_cast<std::ptrdiff_t>(seen[i].begin);
    if (known[i] && known[i]->moves) {
      const auto moving = movingPoints(*known[i], seen[i]);
      std::copy(moving.begin(), moving.end(), all.moves.begin() + begin);
    } else if (!known[i] && isBesideMoving(seen[i])) {
      std::fill_n(all.moves.begin() + begin, count, true);
    }
    std::fill_n(all.weights.begin() + begin, count, (stands ? 1 : unsure) / static_cast<float>(count));
    std::fill_n(is_unsure.begin() + begin, count, !stands);
  }
  markMerged(track_from_scan, seconds, scan, known, all.moves);
  const auto all_unsure = withNeighbours(is_unsure, scan);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (all_unsure[i] && !is_unsure[i]) all.weights[i] = std::min(all.weights[i], unsure);
  }
  return all;
}

std::vector<int> MovingThings::add(const TPose2D& track_from_scan, const Eigen::Vector2f& sensor, double seconds,
                                   ScanWithNormals& scan) {
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const Thing& thing) { return seconds - thing.last.seconds > kOutOfView; }),
                things_.end());
  const ScanView view(track_from_scan, sensor, scan);
  auto seen = sightings(track_from_scan, seconds, scan);
  for (auto& sighting : seen) sighting.viewer = view.origin();
  const auto known = associated(seen, seconds);
  std::vector<Thing> followed;
  std::vector<std::size_t> suspects;  // places in `followed`
  std::vector<int> numbers;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    Thing thing = known[i] ? *known[i] : Thing(next_number_++, seen[i]);
    const double passed = seconds - thing.last.seconds;
    const float width = widthOfThing(seen[i].points);
    if (thing.moves && width > thing.width + kGrown) {
      thing.recognized = {seen[i].centre, seconds};
      thing.has_gone = false;
      thing.width = width;
    }
    thing.width += 0.1F * (width - thing.width);
    if (thing.moves && passed > 0) {
      const Eigen::Vector2f velocity = (seen[i].centre - thing.last.centre) / static_cast<float>(passed);
      thing.velocity += 0.3F * (velocity - thing.velocity);
    }
    const bool is_young = seconds - thing.first_seen < kYoung;
    // Whoever is beside something that moves is likely to move, too: half the distance is enough.
    const bool is_beside = is_young && isBesideMoving(seen[i]);
    const float margin = (is_beside ? 0.5F : 1) * kPassedBy;
    const bool is_suspect = !thing.moves && (standsWhereItWasFree(seen[i], margin) || hasLeftItsPlace(thing, seen[i], view, margin));
    if (is_suspect) suspects.push_back(followed.size());
    if (is_suspect && is_beside) ++thing.suspected;
    if (!is_suspect) thing.suspected = 0;
    confirm(view, seen[i], thing);
    thing.last = seen[i];
    thing.trail.push_back({seen[i].centre, seconds});
    while (seconds - thing.trail.front().seconds > kOldLook) thing.trail.pop_front();
    const bool is_old =
        seconds - thing.anchor.seconds > kAnchored || (view.origin() - thing.anchor.viewer).norm() > kAnchoredFor;
    if (!thing.moves && is_old) {
      thing.anchor = seen[i];
      if (!thing.stands) thing.first_viewer = view.origin();
    }
    numbers.push_back(thing.number);
    followed.push_back(std::move(thing));
  }
  for (auto& number : scan.things) {
    if (number != ScanWithNormals::kNoThing) number = numbers[static_cast<std::size_t>(number)];
  }
  std::vector<int> recognized;
  if (!suspects.empty() && !isPoseWrong(track_from_scan, scan)) {
    for (const std::size_t place : suspects) {
      if (++followed[place].suspected < kSuspected) continue;
      followed[place].moves = true;
      followed[place].last_moved = seconds;
      followed[place].recognized = {followed[place].anchor.centre, seconds};
      followed[place].has_gone = false;
      recognized.push_back(followed[place].number);
    }
  }
  moving_.assign(scan.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (followed[i].moves) reconsider(seen[i], followed[i]);
  }
  markMerged(track_from_scan, seconds, scan, known, moving_);
  for (const auto& thing : things_) {
    const bool is_seen =
        std::any_of(followed.begin(), followed.end(), [&](const Thing& other) { return other.number == thing.number; });
    if (!is_seen) followed.push_back(thing);
  }
  things_ = std::move(followed);
  look(view, seconds);
  last_seconds_ = seconds;
  return recognized;
}

}  // namespace omnimapper::matching
