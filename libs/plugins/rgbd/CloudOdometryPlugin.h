#pragma once

#include <omnimapper/matching/CloudSource.h>
#include <omnimapper/matching/CloudTracker.h>
#include <omnimapper/plugin/PluginFactory.h>

#include "CameraOdometry.h"

namespace omnimapper::plugins {

/// Which library registers the clouds.
struct CloudLibraryOptions {
  enum class Library { omnimapper, pcl };
  Library library = Library::omnimapper;

  static const base::OptionTable<CloudLibraryOptions>& table();
};

/// Odometry by clouds (thesis 4.1.1, 5.3.3.1): edges, voxels or all points of every image of one depth camera are
/// registered with those of a key frame (matching/CloudTracker.h).
class CloudOdometryPlugin : public CameraOdometry {
 public:
  static constexpr const char* kName = "CloudOdometryPlugin";
  static constexpr const char* kSummary =
      "Measures the motion of a depth camera by matching edges, voxels or all points of its images.";

  /// Throws Error(out_of_range) if edges are to be registered by point_to_plane, and Error(unknown_plugin) for a
  /// library that is missing in this build.
  CloudOdometryPlugin(const CameraOdometryOptions& options, const matching::CloudTrackerOptions& tracking,
                      const matching::CloudSourceOptions& source, const matching::CloudMatcherOptions& matching,
                      const CloudLibraryOptions& by = {});

 private:
  bool seeksReturns() const override { return false; }
  ImageMotion track(const StraightImage& image, base::Stamp stamp,
                    const std::optional<motion::PredictedMotion>& prediction) override;

  matching::CloudSourceOptions source_;
  matching::CloudTracker tracker_;
};

}  // namespace omnimapper::plugins
