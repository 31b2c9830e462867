#include <omnimapper/eval/PosePairs.h>

#include <algorithm>
#include <queue>
#include <tuple>

namespace omnimapper::eval {

namespace {

// Keeps which poses of the reference are not paired yet, and finds the next free one on either side of a place.
class FreePoses {
 public:
  explicit FreePoses(std::size_t count) : next_(count + 2), previous_(count + 2) {
    for (std::size_t i = 0; i < next_.size(); ++i) next_[i] = previous_[i] = i;
  }
  // Places are 1 .. count; 0 and count + 1 are the ends, which are never taken.
  std::size_t atOrAfter(std::size_t place) { return follow(next_, place); }
  std::size_t atOrBefore(std::size_t place) { return follow(previous_, place); }
  bool isFree(std::size_t place) const { return next_[place] == place; }
  void take(std::size_t place) {
    next_[place] = place + 1;
    previous_[place] = place - 1;
  }

 private:
  static std::size_t follow(std::vector<std::size_t>& links, std::size_t place) {
    while (links[place] != place) place = links[place] = links[links[place]];
    return place;
  }
  std::vector<std::size_t> next_, previous_;
};

struct Candidate {
  base::Duration distance;
  std::size_t estimate;   // index
  std::size_t reference;  // place: index + 1
  bool operator>(const Candidate& other) const {
    return std::tie(distance, estimate, reference) > std::tie(other.distance, other.estimate, other.reference);
  }
};

}  // namespace

std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& reference, base::Duration tolerance) {
  FreePoses free_poses(reference.size());
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  const auto offerNearestFree = [&](std::size_t i) {
    const base::Stamp stamp = estimate[i].stamp;
    const auto after = std::lower_bound(reference.begin(), reference.end(), stamp,
                                        [](const StampedPose& pose, base::Stamp t) { return pose.stamp < t; });
    const std::size_t place = static_cast<std::size_t>(after - reference.begin());  // of the last pose before
    const std::size_t left = free_poses.atOrBefore(place), right = free_poses.atOrAfter(place + 1);
    const bool has_left = left > 0, has_right = right <= reference.size();
    const base::Duration to_left = has_left ? stamp - reference[left - 1].stamp : base::Duration::max();
    const base::Duration to_right = has_right ? reference[right - 1].stamp - stamp : base::Duration::max();
    if (std::min(to_left, to_right) > tolerance || !(has_left || has_right)) return;
    candidates.push(to_left <= to_right ? Candidate{to_left, i, left} : Candidate{to_right, i, right});
  };

  for (std::size_t i = 0; i < estimate.size(); ++i) offerNearestFree(i);
  std::vector<std::size_t> place_of(estimate.size(), 0);
  while (!candidates.empty()) {
    const Candidate best = candidates.top();
    candidates.pop();
    if (free_poses.isFree(best.reference)) {
      place_of[best.estimate] = best.reference;
      free_poses.take(best.reference);
    } else {
      offerNearestFree(best.estimate);
    }
  }

  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (place_of[i] == 0) continue;
    pairs.push_back({estimate[i].stamp, estimate[i].world_from_body, reference[place_of[i] - 1].world_from_body});
  }
  return pairs;
}

std::vector<PosePair> associateInterpolated(const Trajectory& estimate, const Trajectory& reference,
                                            base::Duration longest_gap) {
  std::vector<PosePair> pairs;
  for (const auto& [stamp, pose] : estimate) {
    if (const auto at_stamp = interpolatedPose(reference, stamp, longest_gap))
      pairs.push_back({stamp, pose, *at_stamp});
  }
  return pairs;
}

}  // namespace omnimapper::eval
