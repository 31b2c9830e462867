#include "CloudOdometryPlugin.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/FeatureLibraries.h>

#include "openDirections.h"

namespace omnimapper::plugins {

const base::OptionTable<CloudLibraryOptions>& CloudLibraryOptions::table() {
  using Options = CloudLibraryOptions;
  static const auto table = base::OptionTable<Options>().choice(
      "library", &Options::library, {{"omnimapper", Library::omnimapper}, {"pcl", Library::pcl}},
      "Implementation of the matching: OmniMapper's own, or that of PCL (Point Cloud Library), which is slower.");
  return table;
}

namespace {

std::unique_ptr<const matching::CloudMatcher> matcherOf(const CloudLibraryOptions& by,
                                                        const matching::CloudMatcherOptions& matching) {
  if (by.library == CloudLibraryOptions::Library::omnimapper)
    return std::make_unique<matching::IteratedClosestPoints>(matching);
  const auto make = reinterpret_cast<matching::CloudMatcher* (*)(const matching::CloudMatcherOptions&)>(
      base::functionOfFeature("omnimapperPclMatcher", "PCL cannot match clouds", "set library = omnimapper"));
  return std::unique_ptr<const matching::CloudMatcher>(make(matching));
}

}  // namespace

CloudOdometryPlugin::CloudOdometryPlugin(const CameraOdometryOptions& options,
                                         const matching::CloudTrackerOptions& tracking,
                                         const matching::CloudSourceOptions& source,
                                         const matching::CloudMatcherOptions& matching, const CloudLibraryOptions& by)
    : CameraOdometry(options, "odometry by clouds"), source_(source), tracker_(tracking, matcherOf(by, matching)) {
  const bool has_normals =
      source.source == matching::CloudSource::voxels || source.source == matching::CloudSource::all_points;
  if (matching.method == matching::CloudMethod::point_to_plane && !has_normals) {
    throw base::Error(base::ExitCode::out_of_range,
                      "method = point_to_plane needs normals, which edges do not have: set source = voxels or "
                      "all_points, or register edges with method = gicp or point_to_point");
  }
}

ImageMotion CloudOdometryPlugin::track(const StraightImage& image, base::Stamp stamp,
                                       const std::optional<motion::PredictedMotion>& prediction) {
  using How = matching::CloudTracker::Tracked::How;
  const camera::RgbdView& view = image.view();
  auto cloud = std::make_shared<const matching::MatchCloud>(matching::cloudOf(view.depth(), view.colour(), source_));
  const auto tracked = tracker_.track(stamp, std::move(cloud), prediction);
  ImageMotion motion;
  motion.how = tracked.how == How::lost    ? ImageMotion::How::lost
               : tracked.how == How::begun ? ImageMotion::How::begun
                                           : ImageMotion::How::tracked;
  motion.last_from_camera = tracked.last_from_camera;
  motion.last = tracked.last;
  if (tracked.match.open_directions > 0)
    motion.open = openDirections(tracked.match.covariance, matching::CloudMatch::kOpen);
  return motion;
}

}  // namespace omnimapper::plugins
