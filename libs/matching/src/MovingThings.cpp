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
constexpr double kFresh = 0.4;             // [s] in which a thing may not have left its place yet
constexpr float kPassedBy = 0.2F;          // [m] by which a beam must have passed
constexpr float kBeside = 0.5F;            // [m] from a thing that moves, within which the other leg may be
constexpr float kPassedByBeside = 0.1F;    // [m] the same for what is beside something that moves
constexpr double kYoung = 1;               // [s] for which a new thing may be that leg
constexpr int kSuspected = 2;              // scans in a row
constexpr double kAnchored = 3;            // [s] for which the place of a thing that stands is kept
constexpr float kAnchoredFor = 1;      // [m] of motion of the laser, after which other sides of the thing are in view
constexpr float kGrown = 0.25F;        // [m] by which a thing is larger once it is of one piece with another
constexpr double kGoesNowhere = 2;     // [s] in which a thing of which that is doubted must go on
constexpr float kGone = 0.25F;         // [m] as far as this
constexpr double kStandsNow = 1;       // [s] for which all that is left of a thing stood there before it came
constexpr float kMerged = 0.3F;        // [m] from the expected centre of a leg that is of one piece with a wall
constexpr float kCame = 0.5F;          // [m] from its place, at least, before it came
constexpr float kSamePlace = 0.08F;    // [m] from the end of a beam, within which a place was occupied
constexpr float kMostlyStands = 0.7F;  // share of points

// Whether a thing has left its place: a beam passes there now.
bool hasLeft(const ThingSighting& before, const ThingSighting& now, const ScanView& view, float margin) {
  if ((now.centre - before.centre).norm() < 1.5F * margin || !isWideFor(view, before.points)) return false;
  if (5 * overlapping(now.points, before.points) > now.points.size()) return false;
  constexpr float kFree = 0.69F;
  return sharesSeen(view, before.points, margin).free > kFree;
}

}  // namespace

Eigen::Vector2f MovingThings::Thing::at(double seconds) const {
  return last.centre + static_cast<float>(std::max(0.0, seconds - last.seconds)) * velocity;
}

// The known thing that each sighting is of, or null. The nearest pairs are taken first.
std::vector<const MovingThings::Thing*> MovingThings::associated(const std::vector<ThingSighting>& sightings,
                                                                 double seconds) const {
  struct Pair {
    float distance;
    std::size_t sighting, thing;
  };
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < things_.size(); ++k) {
    const auto passed = static_cast<float>(std::max(0.0, seconds - things_[k].last.seconds));
    const float reach = kThingReach + kThingReachPerSecond * std::min(1.0F, passed);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const float distance = (sightings[i].centre - things_[k].at(seconds)).norm();
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

bool MovingThings::isBesideMoving(const ThingSighting& sighting) const {
  return std::any_of(things_.begin(), things_.end(), [&](const Thing& thing) {
    return thing.moves && sighting.seconds - thing.last.seconds < kYoung &&
           (thing.last.centre - sighting.centre).norm() < kBeside;
  });
}

// Of a thing that moves, the points whose places were not occupied before it came.
std::vector<bool> MovingThings::movingPoints(const Thing& thing) const {
  const auto& now = thing.last;
  std::vector<bool> moving(now.points.size(), true);
  const auto came = std::find_if(thing.trail.rbegin(), thing.trail.rend(),
                                 [&](const Passed& passed) { return (passed.centre - now.centre).norm() > kCame; });
  if (came == thing.trail.rend()) return moving;
  for (std::size_t i = 0; i < now.points.size(); ++i)
    moving[i] = !views_.at(now.points[i], kSamePlace, came->seconds).isOccupied();
  return moving;
}

// Marks points of walls that are where a thing that moves is expected, and where earlier beams passed freely: a leg
// that is so near a wall that no gap shows between them.
void MovingThings::markMerged(const TPose2D& track_from_scan, double seconds, const ScanWithNormals& scan,
                              const std::vector<const Thing*>& known, std::vector<bool>& moves) const {
  const ToTrack toTrack(track_from_scan);
  for (const auto& thing : things_) {
    const bool is_seen = std::find(known.begin(), known.end(), &thing) != known.end();
    if (!thing.moves || is_seen || seconds - thing.last.seconds > kYoung) continue;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (scan.things[i] != ScanWithNormals::kNoThing) continue;
      const Eigen::Vector2f place = toTrack(scan.points[i]);
      if ((place - thing.at(seconds)).norm() > kMerged) continue;
      if (views_.at(place, kPassedByBeside, seconds - kFresh).isFree()) moves[i] = true;
    }
  }
}

MovingThings::Expected MovingThings::expected(const TPose2D& track_from_scan, double seconds,
                                              const ScanWithNormals& scan) const {
  // A thing that may move determines a position to kUnsure in kAlike, within which its errors are the same.
  constexpr double kPoint = 0.02, kUnsure = 0.05, kAlike = 2;  // [m] [m] [s]
  const double part = std::clamp((seconds - last_seconds_) / kAlike, 0.0, 1.0);
  const auto unsure = static_cast<float>(kPoint * kPoint / (kUnsure * kUnsure) * part);
  const auto seen = sightingsIn(track_from_scan, Eigen::Vector2f::Zero(), seconds, scan);
  const auto known = associated(seen, seconds);
  Expected all{std::vector<bool>(scan.size(), false), std::vector<float>(scan.size(), 1)};
  std::vector<bool> is_unsure(scan.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool stands = known[i] && known[i]->stands;
    const auto count = seen[i].points.size();
    const auto begin = static_cast<std::ptrdiff_t>(seen[i].begin);
    if (known[i] && known[i]->moves) {
      Thing thing = *known[i];
      thing.last = seen[i];
      const auto moving = movingPoints(thing);
      std::copy(moving.begin(), moving.end(), all.moves.begin() + begin);
    } else if (!known[i]) {
      std::fill_n(all.moves.begin() + begin, count, isBesideMoving(seen[i]));
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

// The things that are in view, one for each sighting. A thing that has become larger may be two, of which one stands.
std::vector<MovingThings::Thing> MovingThings::following(const std::vector<ThingSighting>& seen,
                                                         const std::vector<const Thing*>& known) {
  std::vector<Thing> followed;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto& now = seen[i];
    Thing thing = known[i] ? *known[i] : Thing(next_number_++, now);
    const float extent = extentOf(now.points);
    if (thing.moves && extent > thing.extent + kGrown) {
      thing.doubted = {now.centre, now.seconds};
      thing.has_gone = false;
      thing.extent = extent;
    }
    constexpr float kMemory = 0.9F;
    thing.extent = kMemory * thing.extent + (1 - kMemory) * extent;
    const double passed = now.seconds - thing.last.seconds;
    constexpr double kShortest = 0.02;  // [s] between nearly coincident stamps noise looks like speed
    if (thing.moves && passed > kShortest) {
      const Eigen::Vector2f velocity = (now.centre - thing.last.centre) / static_cast<float>(passed);
      thing.velocity += 0.3F * (velocity - thing.velocity);
    }
    thing.last = now;
    thing.trail.push_back({now.centre, now.seconds});
    while (now.seconds - thing.trail.front().seconds > RecentViews::kKept) thing.trail.pop_front();
    followed.push_back(std::move(thing));
  }
  return followed;
}

// Which things are found to move. Whatever is beside something that moves is likely to move, too: less is asked of it.
std::vector<int> MovingThings::recognize(const ScanView& view, const ScanWithNormals& scan,
                                         const TPose2D& track_from_scan, std::vector<Thing>& followed) const {
  bool are_suspects = false;
  for (auto& thing : followed) {
    if (thing.moves) continue;
    const auto& now = thing.last;
    const bool is_beside = now.seconds - thing.first_seen < kYoung && isBesideMoving(now);
    const float margin = is_beside ? kPassedByBeside : kPassedBy;
    const bool is_suspect =
        views_.at(now.points, margin, now.seconds - kFresh).isFree() || hasLeft(thing.anchor, now, view, margin);
    if (!is_suspect) thing.suspected = 0;
    if (is_suspect) thing.suspected += is_beside ? kSuspected : 1;
    are_suspects = are_suspects || is_suspect;
  }
  std::vector<int> recognized;
  if (!are_suspects) return recognized;
  if (views_.contradict(track_from_scan, scan)) {
    for (auto& thing : followed) thing.suspected = 0;
    return recognized;
  }
  for (auto& thing : followed) {
    if (thing.moves || thing.suspected < kSuspected) continue;
    thing.moves = true;
    thing.last_moved = thing.last.seconds;
    thing.doubted = {thing.anchor.centre, thing.last.seconds};
    thing.has_gone = false;
    recognized.push_back(thing.number);
  }
  return recognized;
}

// A thing stands if its points stay where they are while the laser moves on; then it was a mistake to say that it
// moves, as of a chair beside somebody who walked by. So it was if it goes nowhere, or only where something was before:
// other sides of a chair have come into view, or somebody who walked past it has passed their name on to it. It is no
// longer sure to stand once its points are elsewhere. Marks the points that move.
void MovingThings::reconsider(const ScanView& view, Thing& thing) {
  constexpr float kMovedOn = 0.5F;  // [m] of the laser
  const auto& now = thing.last;
  const auto overlaps = overlapping(now.points, thing.anchor.points);
  const bool is_where_it_was = 2 * overlaps > now.points.size();
  if (5 * overlaps < now.points.size()) thing.stands = false;
  bool stands = is_where_it_was && (view.origin() - thing.first_viewer).norm() > kMovedOn;
  if (thing.moves && !stands) {
    const auto moving = movingPoints(thing);
    const auto count = static_cast<float>(std::count(moving.begin(), moving.end(), true));
    if (count > (1 - kMostlyStands) * static_cast<float>(moving.size())) thing.last_moved = now.seconds;
    thing.has_gone = thing.has_gone || (now.centre - thing.doubted.centre).norm() > kGone;
    const bool goes_nowhere = !thing.has_gone && now.seconds - thing.doubted.seconds > kGoesNowhere;
    stands = goes_nowhere || now.seconds - thing.last_moved > kStandsNow;
    if (!stands) std::copy(moving.begin(), moving.end(), moving_.begin() + static_cast<std::ptrdiff_t>(now.begin));
    if (stands) thing.anchor = now;
  }
  if (!stands) return;
  thing.stands = true;
  thing.moves = false;
  thing.suspected = 0;
  thing.velocity.setZero();
}

std::vector<int> MovingThings::add(const TPose2D& track_from_scan, const Eigen::Vector2f& sensor, double seconds,
                                   ScanWithNormals& scan) {
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const Thing& thing) { return seconds - thing.last.seconds > kOutOfView; }),
                things_.end());
  const ScanView view(track_from_scan, sensor, scan);
  const auto seen = sightingsIn(track_from_scan, sensor, seconds, scan);
  const auto known = associated(seen, seconds);
  auto followed = following(seen, known);
  for (auto& number : scan.things) {
    if (number != ScanWithNormals::kNoThing) number = followed[static_cast<std::size_t>(number)].number;
  }
  auto recognized = recognize(view, scan, track_from_scan, followed);
  moving_.assign(scan.size(), false);
  for (auto& thing : followed) {
    reconsider(view, thing);
    if (!thing.moves)
      recognized.erase(std::remove(recognized.begin(), recognized.end(), thing.number), recognized.end());
    const auto& anchor = thing.anchor;
    const bool is_old = seconds - anchor.seconds > kAnchored || (view.origin() - anchor.viewer).norm() > kAnchoredFor;
    if (thing.moves || !is_old) continue;
    thing.anchor = thing.last;
    if (!thing.stands) thing.first_viewer = view.origin();
  }
  markMerged(track_from_scan, seconds, scan, known, moving_);
  for (auto& thing : things_) {
    if (std::find(known.begin(), known.end(), &thing) == known.end()) followed.push_back(std::move(thing));
  }
  things_ = std::move(followed);
  views_.add(view, seconds);
  last_seconds_ = seconds;
  return recognized;
}

}  // namespace omnimapper::matching
