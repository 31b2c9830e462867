#pragma once

#include <omnimapper/matching/RgbdTracker.h>
#include <omnimapper/plugin/SharedSection.h>

#include "CameraOdometry.h"

namespace omnimapper::plugins {

/// Dense visual odometry: every image of one depth camera is registered, by depth and brightness, with an earlier key
/// frame (matching/RgbdTracker.h).
class VisualOdometryPlugin : public CameraOdometry {
 public:
  static constexpr const char* kName = "VisualOdometryPlugin";
  static constexpr const char* kSummary =
      "Measures the motion of a depth camera by matching each depth image and its picture with earlier ones.";

  VisualOdometryPlugin(const CameraOdometryOptions& options, const matching::RgbdTrackerOptions& tracking,
                       const matching::DenseMatcherOptions& matching,
                       const matching::FeatureMatcherOptions& features = {});

 private:
  ImageMotion track(const StraightImage& image, base::Stamp stamp,
                    const std::optional<motion::PredictedMotion>& prediction) override;

  matching::RgbdTracker tracker_;
};

/// The options in an INI section of VisualOdometryPlugin.
using VisualOdometrySection = mapper::SharedSection<CameraOdometryOptions, matching::RgbdTrackerOptions,
                                                    matching::DenseMatcherOptions, matching::FeatureMatcherOptions>;

}  // namespace omnimapper::plugins
