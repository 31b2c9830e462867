#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace omnimapper::matching {

/// Points of one view, in its sensor's frame.
struct CloudPoints {
  std::vector<Eigen::Vector3f> points;   ///< [m]
  std::vector<Eigen::Vector3f> normals;  ///< unit surface normals; NaN where there is none; empty if not known
  /// [m2] Covariance of the position at which a point may be measured again: noise and, along surfaces and lines, the
  /// distance to the next point. Empty if not known.
  std::vector<Eigen::Matrix3f> covariances;
};

/// Points with a KD-tree over them, which is built when it is first needed. Immutable; functions may be called from
/// several threads.
class MatchCloud {
 public:
  /// Throws Error(out_of_range) for points or covariances that are not finite, and if there are normals or covariances,
  /// but not one for each point.
  explicit MatchCloud(CloudPoints cloud);
  ~MatchCloud();
  MatchCloud(const MatchCloud&) = delete;
  MatchCloud& operator=(const MatchCloud&) = delete;

  std::size_t size() const { return cloud_.points.size(); }
  const CloudPoints& cloud() const { return cloud_; }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// Index of the nearest point within `max_distance` [m], or kNone.
  std::size_t nearest(const Eigen::Vector3f& to, float max_distance) const;

 private:
  struct Tree;
  const Tree& tree() const;
  CloudPoints cloud_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const Tree> tree_;
};

}  // namespace omnimapper::matching
