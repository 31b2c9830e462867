#include "VisualOdometryPlugin.h"

#include "openDirections.h"

namespace omnimapper::plugins {

VisualOdometryPlugin::VisualOdometryPlugin(const CameraOdometryOptions& options,
                                           const matching::RgbdTrackerOptions& tracking,
                                           const matching::DenseMatcherOptions& matching,
                                           const matching::FeatureMatcherOptions& features)
    : CameraOdometry(options, "visual odometry"), tracker_(tracking, matching, features) {}

ImageMotion VisualOdometryPlugin::track(const StraightImage& image, base::Stamp stamp,
                                        const std::optional<motion::PredictedMotion>& prediction) {
  using How = matching::RgbdTracker::Tracked::How;
  const auto tracked = tracker_.track(stamp, image.pyramid(), prediction);
  ImageMotion motion;
  motion.how = tracked.how == How::lost    ? ImageMotion::How::lost
               : tracked.how == How::begun ? ImageMotion::How::begun
               : tracked.how == How::found ? ImageMotion::How::found
                                           : ImageMotion::How::tracked;
  motion.last_from_camera = tracked.last_from_camera;
  motion.last = tracked.last;
  motion.seen_before = tracked.seen_before;
  if (tracked.match.open_directions > 0)
    motion.open = openDirections(tracked.match.covariance, matching::DenseMatch::kOpen);
  return motion;
}

}  // namespace omnimapper::plugins
