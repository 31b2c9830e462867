#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/perception/ColourImage.h>
#include <omnimapper/perception/DepthImage.h>

#include <memory>

namespace omnimapper::perception {

/// The depth image of a range camera's observation, in its optical frame, and the colour of each of its pixels.
class RgbdView {
 public:
  /// The observation must outlive it. Throws Error(missing_images) for images in files that were not loaded, and
  /// Error(unreadable_input) for a camera without a calibration.
  explicit RgbdView(const mrpt::obs::CObservation3DRangeScan& scan);
  ~RgbdView();
  RgbdView(const RgbdView&) = delete;
  RgbdView& operator=(const RgbdView&) = delete;

  const DepthImage& depth() const;
  /// Null without a picture of 8 bits. A picture of another view is converted to the view of the depths, where pixels
  /// that it does not show are black.
  const ColourImage* colour() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace omnimapper::perception
