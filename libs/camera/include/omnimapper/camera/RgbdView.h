#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/camera/ColourImage.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/obs/Rgb.h>

#include <memory>
#include <vector>

namespace omnimapper::camera {

/// The decoded images of a range camera's observation: the depth image, in its optical frame, and the colour of each of
/// its pixels. What takes time is computed when it is first requested, so one thread at a time uses the object.
class RgbdView {
 public:
  /// The observation must outlive this object. Throws Error(missing_images) for images in files that were not loaded,
  /// and Error(unreadable_input) for a camera without a calibration.
  explicit RgbdView(const mrpt::obs::CObservation3DRangeScan& scan);
  ~RgbdView();
  RgbdView(const RgbdView&) = delete;
  RgbdView& operator=(const RgbdView&) = delete;

  const DepthImage& depth() const;
  /// The colours of single points, from the picture as the camera took it.
  const ScanColours& colours() const;
  /// The colours of the depth image's pixels, row by row; black where there is no depth or no colour.
  const std::vector<obs::Rgb>& coloursOfDepths() const;
  /// The colours of the depth image's pixels; null if there is no picture of 8 bits. A picture with another view is
  /// converted to the view of the depth image; pixels that the picture does not show are black then.
  const ColourImage* colour() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace omnimapper::camera
