#include "SignTracks.h"

#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

constexpr std::size_t kMostTogether = 50;  // views of one text that are compared with one another

}  // namespace

const SignPayload& signOf(const mapper::State& state, base::LandmarkId id) {
  return dynamic_cast<const SignPayload&>(*state.map.landmark(id).payload);
}

void SignTracks::goTo(const map::KeyFrame& frame, const mapper::State& state, double recent_travel) {
  if (!last_pose_ || frame.stamp > last_stamp_) {  // a frame that came late does not count
    if (last_pose_ && state.graph.contains(*last_pose_))
      travelled_ += mapper::poseOf(state.graph, *last_pose_).distanceTo(mapper::poseOf(state.graph, frame.pose));
    last_pose_ = frame.pose;
    last_stamp_ = frame.stamp;
  }
  while (!waiting_.empty() && travelled_ - waiting_.front().last_seen > recent_travel) {
    for (const auto& view : waiting_.front().views) keepForTheEnd(view);
    waiting_.pop_front();
  }
}

void SignTracks::add(base::LandmarkId id) {
  LandmarkIndex::add(id);
  seen(id);
  fresh.push_back(id);
}

std::vector<SignView>& SignTracks::waitingWith(const SignView& view, double recent_travel) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return waiting.views.back().label == view.label &&
           agreementOf(waiting.views.back().measurement.text, view.measurement.text) == Agreement::agrees;
  });
  Waiting waiting{{}, travelled_};
  if (found != waiting_.end()) {
    waiting = std::move(*found);
    waiting.last_seen = travelled_;
    waiting_.erase(found);
    const auto is_old = [&](const SignView& each) { return travelled_ - each.travelled > recent_travel; };
    auto& views = waiting.views;
    for (const auto& each : views)
      if (is_old(each)) keepForTheEnd(each);
    views.erase(std::remove_if(views.begin(), views.end(), is_old), views.end());
    if (views.size() >= kMostTogether) {  // a base that stands still sees the same sign again and again
      keepForTheEnd(views.front());
      views.erase(views.begin());
    }
  }
  waiting.views.push_back(view);
  waiting_.push_back(std::move(waiting));
  return waiting_.back().views;
}

// The number of views is limited, so that the log of a whole day does not fill the memory.
void SignTracks::keepForTheEnd(const SignView& view) {
  constexpr std::size_t kMost = 1000;
  unplaced_.push_back(view);
  if (unplaced_.size() > kMost) unplaced_.pop_front();
}

std::vector<std::vector<SignView>> SignTracks::unplacedViews(double recent_travel) const {
  std::vector<std::vector<SignView>> groups;
  const auto add = [&](const SignView& view) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& views) {
      return views.size() < kMostTogether && views.back().label == view.label &&
             std::abs(views.back().travelled - view.travelled) <= recent_travel &&
             agreementOf(views.back().measurement.text, view.measurement.text) == Agreement::agrees;
    });
    if (group == groups.end()) {
      groups.push_back({view});
    } else {
      group->push_back(view);
    }
  };
  for (const auto& view : unplaced_) add(view);
  for (const auto& waiting : waiting_)
    for (const auto& view : waiting.views) add(view);
  return groups;
}

void SignTracks::forget(const std::vector<std::size_t>& which) {
  auto& views = waiting_.back().views;
  for (auto i = which.rbegin(); i != which.rend(); ++i) views.erase(views.begin() + static_cast<std::ptrdiff_t>(*i));
  if (views.empty()) waiting_.pop_back();
}

}  // namespace omnimapper::plugins
