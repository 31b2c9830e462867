#pragma once

#include <omnimapper/camera/LensStraightener.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/matching/RgbdPyramid.h>
#include <omnimapper/perception/Blackboard.h>

#include <memory>
#include <optional>

namespace omnimapper::plugins {

/// An image of a depth camera without the distortion of the lens, which odometry and links between views match. It is
/// made once for each image and shared on the image's blackboard. One thread at a time uses it.
class StraightImage {
 public:
  using ScanPtr = mrpt::obs::CObservation3DRangeScan::ConstPtr;

  /// Throws as camera::LensStraightener and camera::RgbdView.
  StraightImage(ScanPtr scan, const camera::LensStraightener& lens);
  StraightImage(const StraightImage&) = delete;
  StraightImage& operator=(const StraightImage&) = delete;

  const camera::RgbdView& view() const { return view_; }
  /// Throws Error(unreadable_input) as matching::RgbdPyramid.
  const matching::RgbdPyramid& pyramid() const;

  bool isOf(const mrpt::obs::CObservation& observation) const { return scan_.get() == &observation; }
  /// Adds the image, and its decoded images if they are those of the observation, to the observation's blackboard.
  static void share(const std::shared_ptr<const StraightImage>& image, perception::Blackboard& board);

 private:
  ScanPtr scan_, straight_;  // the same without distortion
  camera::RgbdView view_;
  mutable std::optional<matching::RgbdPyramid> pyramid_;  // once it was requested
};

}  // namespace omnimapper::plugins
