#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <algorithm>

namespace omnimapper::map {

namespace {

/// Spreads the disagreement of the continuous source and the optimized next key frame over the frames between.
class Spread {
 public:
  Spread(const KeyFrame& begin, const KeyFrame& end)
      : begin_(begin.stamp),
        seconds_(base::secondsBetween(begin.stamp, end.stamp)),
        map_from_begin_(geometry::fromMrpt(begin.map_from_base)),
        begin_from_measured_end_(geometry::fromMrpt(begin.keyframe_from_next)),
        disagreement_(
            geometry::minus(geometry::fromMrpt(end.map_from_base), map_from_begin_ * begin_from_measured_end_)) {}

  // The disagreement is a tangent at the measured end. Rotated into the dependent frame, it is the same translation and
  // rotation in the map, and the frame gets a share of it by its time. At the end the share is 1, which gives the next
  // key frame.
  mrpt::poses::CPose3D operator()(const DependentFrame& frame) const {
    const double share = std::clamp(base::secondsBetween(begin_, frame.stamp) / seconds_, 0.0, 1.0);
    const geometry::Se3 begin_from_frame = geometry::fromMrpt(frame.keyframe_from_base);
    const Eigen::Quaterniond turn = begin_from_frame.rotation.conjugate() * begin_from_measured_end_.rotation;
    geometry::Vector6d step;
    step << turn * disagreement_.head<3>(), turn * disagreement_.tail<3>();
    return geometry::toMrpt(geometry::plus(map_from_begin_ * begin_from_frame, share * step));
  }

 private:
  base::Stamp begin_;
  double seconds_;
  geometry::Se3 map_from_begin_, begin_from_measured_end_;
  geometry::Vector6d disagreement_;
};

}  // namespace

std::vector<StampedPose> denseTrajectory(const Map& map) {
  std::vector<StampedPose> trajectory;
  std::size_t size = map.key_frames.size();
  for (const KeyFrame& frame : map.key_frames) size += frame.dependents.size();
  trajectory.reserve(size);
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    const KeyFrame& frame = map.key_frames[i];
    if (frame.reference) trajectory.push_back({frame.stamp, frame.map_from_base, frame.id.session});
    if (frame.dependents.empty()) continue;
    if (i + 1 == map.key_frames.size() || map.key_frames[i + 1].id.session != frame.id.session) {
      for (const DependentFrame& dependent : frame.dependents) {
        trajectory.push_back({dependent.stamp, frame.map_from_base + dependent.keyframe_from_base, frame.id.session});
      }
    } else {
      const Spread spread(frame, map.key_frames[i + 1]);
      for (const DependentFrame& dependent : frame.dependents)
        trajectory.push_back({dependent.stamp, spread(dependent), frame.id.session});
    }
  }
  return trajectory;
}

mrpt::poses::CPose3D newestPose(const Map& map) {
  const KeyFrame& newest = map.key_frames.back();
  return newest.dependents.empty() ? newest.map_from_base
                                   : newest.map_from_base + newest.dependents.back().keyframe_from_base;
}

}  // namespace omnimapper::map
