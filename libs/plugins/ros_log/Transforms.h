#pragma once

#include <omnimapper/geometry/Se3.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace omnimapper::ros {

/// The tree of frames that tf and tf_static describe, over the last while. Times are in nanoseconds since 1970.
class Transforms {
 public:
  /// A pose of `child` in `parent`. Transforms need not come in the order of their times. One that is not finite, or of
  /// a frame in itself, is left out. A child that gets another parent is from then on in that one.
  void add(const std::string& parent, const std::string& child, std::int64_t time,
           const geometry::Se3& parent_from_child, bool is_static);

  /// a_from_b at a time, interpolated between the transforms around it; none if the frames are not connected, or if a
  /// transform on the way has none within `tolerance` [ns] of that time. A joint that never moved counts as static.
  std::optional<geometry::Se3> between(const std::string& a, const std::string& b, std::int64_t time,
                                       std::int64_t tolerance) const;
  /// Whether the frames are connected.
  bool connects(const std::string& a, const std::string& b) const;
  bool has(const std::string& frame) const;
  /// The frames from this one up to the root of its tree.
  std::vector<std::string> chainFrom(const std::string& frame) const;
  /// The frames that moved in their parents, each with its parent.
  std::map<std::string, std::string> movingFrames() const;

  /// Forgets transforms before this time, but the last of each frame.
  void forgetBefore(std::int64_t time);
  /// Whether nothing was added.
  bool empty() const { return edges_.empty(); }

 private:
  struct Edge {
    std::string parent;
    bool is_static = false, has_moved = false;
    std::map<std::int64_t, geometry::Se3> poses;  // parent_from_child by time
  };
  static std::optional<geometry::Se3> poseAt(const Edge& edge, std::int64_t time, std::int64_t tolerance);
  std::optional<geometry::Se3> rootFrom(const std::vector<std::string>& chain, std::size_t length, std::int64_t time,
                                        std::int64_t tolerance) const;

  std::map<std::string, Edge> edges_;  // by child
  std::set<std::string> parents_;
};

/// The name of a frame without the slash that tf of ROS 1 has before it.
std::string frameName(std::string_view name);

}  // namespace omnimapper::ros
