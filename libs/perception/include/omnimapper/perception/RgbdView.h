#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/perception/ColourImage.h>
#include <omnimapper/perception/DepthImage.h>

#include <memory>

namespace omnimapper::perception {

/// The depth image of a range camera's observation, in its optical frame, and what its picture shows in each pixel of
/// it.
class RgbdView {
 public:
  /// The observation must outlive it. Throws Error(missing_images) for images in files that were not loaded, and
  /// Error(unreadable_input) for a camera without a calibration.
  explicit RgbdView(const mrpt::obs::CObservation3DRangeScan& scan);
  ~RgbdView();
  RgbdView(const RgbdView&) = delete;
  RgbdView& operator=(const RgbdView&) = delete;

  const DepthImage& depth() const;
  /// Null without a picture of 8 bits. One of another view is turned into that of the depths; what it does not show is
  /// black there.
  const ColourImage* colour() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace omnimapper::perception
