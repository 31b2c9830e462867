#include "Transforms.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace omnimapper::ros {

namespace {

constexpr std::size_t kLongestChain = 100;   // frames
constexpr std::size_t kMostFrames = 10'000;  // a log can name any number
constexpr std::size_t kMostPoses = 100'000;  // of one frame

bool isNear(const geometry::Se3& a, const geometry::Se3& b) {
  constexpr double kLength = 1e-4, kAngle = 1e-4;  // [m], [rad] of rounding
  const auto difference = geometry::minus(b, a);
  return difference.head<3>().norm() < kLength && difference.tail<3>().norm() < kAngle;
}

geometry::Se3 interpolated(const geometry::Se3& a, const geometry::Se3& b, double share) {
  return {a.rotation.slerp(share, b.rotation).normalized(), a.translation + share * (b.translation - a.translation)};
}

}  // namespace

std::string frameName(std::string_view name) {
  return std::string(name.substr(std::min(name.find_first_not_of('/'), name.size())));
}

void Transforms::add(const std::string& parent, const std::string& child, std::int64_t time,
                     const geometry::Se3& parent_from_child, bool is_static) {
  const bool is_finite =
      parent_from_child.translation.allFinite() && std::abs(parent_from_child.rotation.norm() - 1) < 1e-3;
  if (!is_finite || parent == child || child.empty()) return;
  if (edges_.size() >= kMostFrames && edges_.count(child) == 0) return;
  Edge& edge = edges_[child];
  if (edge.parent != parent) edge = {parent, is_static, false, {}};
  if (parents_.size() < kMostFrames) parents_.insert(parent);
  if (!edge.poses.empty() && !isNear(edge.poses.begin()->second, parent_from_child)) edge.has_moved = true;
  edge.is_static = is_static;
  if (is_static) edge.poses.clear();
  edge.poses[time] = parent_from_child;
  if (edge.poses.size() > kMostPoses) edge.poses.erase(edge.poses.begin());
}

std::optional<geometry::Se3> Transforms::poseAt(const Edge& edge, std::int64_t time, std::int64_t tolerance) {
  if (edge.is_static || !edge.has_moved) return edge.poses.rbegin()->second;
  const auto after = edge.poses.lower_bound(time);
  const bool has_after = after != edge.poses.end() && after->first - time <= tolerance;
  const auto before = after == edge.poses.begin() ? edge.poses.end() : std::prev(after);
  const bool has_before = before != edge.poses.end() && time - before->first <= tolerance;
  if (has_after && has_before) {
    const double share = static_cast<double>(time - before->first) / static_cast<double>(after->first - before->first);
    return interpolated(before->second, after->second, share);
  }
  if (has_after) return after->second;
  if (has_before) return before->second;
  return std::nullopt;
}

std::vector<std::string> Transforms::chainFrom(const std::string& frame) const {
  std::vector<std::string> chain{frame};
  for (auto edge = edges_.find(frame); edge != edges_.end() && chain.size() < kLongestChain;
       edge = edges_.find(chain.back()))
    chain.push_back(edge->second.parent);
  return chain;
}

std::optional<geometry::Se3> Transforms::rootFrom(const std::vector<std::string>& chain, std::size_t length,
                                                  std::int64_t time, std::int64_t tolerance) const {
  geometry::Se3 root_from_frame;
  for (std::size_t i = 0; i < length; ++i) {
    const auto pose = poseAt(edges_.at(chain[i]), time, tolerance);
    if (!pose) return std::nullopt;
    root_from_frame = *pose * root_from_frame;
  }
  return root_from_frame;
}

std::optional<geometry::Se3> Transforms::between(const std::string& a, const std::string& b, std::int64_t time,
                                                 std::int64_t tolerance) const {
  const auto from_a = chainFrom(a), from_b = chainFrom(b);
  for (std::size_t i = 0; i < from_a.size(); ++i) {
    const auto common = std::find(from_b.begin(), from_b.end(), from_a[i]);
    if (common == from_b.end()) continue;
    const auto common_from_a = rootFrom(from_a, i, time, tolerance);
    const auto common_from_b = rootFrom(from_b, static_cast<std::size_t>(common - from_b.begin()), time, tolerance);
    if (!common_from_a || !common_from_b) return std::nullopt;
    return geometry::inverse(*common_from_a) * *common_from_b;
  }
  return std::nullopt;
}

bool Transforms::connects(const std::string& a, const std::string& b) const {
  return chainFrom(a).back() == chainFrom(b).back();
}

bool Transforms::has(const std::string& frame) const {
  return edges_.count(frame) > 0 || parents_.count(frame) > 0;
}

std::map<std::string, std::string> Transforms::movingFrames() const {
  std::map<std::string, std::string> frames;
  for (const auto& [child, edge] : edges_)
    if (edge.has_moved && !edge.is_static) frames[child] = edge.parent;
  return frames;
}

void Transforms::forgetBefore(std::int64_t time) {
  for (auto& child_and_edge : edges_) {
    auto& poses = child_and_edge.second.poses;
    const auto kept = poses.lower_bound(time);
    poses.erase(poses.begin(), kept == poses.end() && !poses.empty() ? std::prev(kept) : kept);
  }
}

}  // namespace omnimapper::ros
