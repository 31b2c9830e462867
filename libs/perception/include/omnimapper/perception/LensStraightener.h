#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <memory>
#include <optional>

namespace omnimapper::perception {

/// Takes the distortion of the lenses out of the images of one range camera: what OpenCV's and MRPT's models of lenses
/// move (radial and tangential, or fisheye) is moved back, so that a pinhole with the same focal lengths and centre
/// shows it.
class LensStraightener {
 public:
  LensStraightener();
  ~LensStraightener();
  LensStraightener(const LensStraightener&) = delete;
  LensStraightener& operator=(const LensStraightener&) = delete;

  /// The images of `scan`, straight, with cameras without distortion, or `scan` itself where its lenses move nothing by
  /// a third of a pixel or its calibration is no calibration. Beside the images only times, names and poses are kept:
  /// no points and no confidences. What the lens did not show has no depth and is black.
  /// Throws Error(missing_images) where the picture is in a file that cannot be read.
  mrpt::obs::CObservation3DRangeScan::ConstPtr straightened(const mrpt::obs::CObservation3DRangeScan::ConstPtr& scan);

 private:
  struct Map;
  /// Of the camera and an image of that size; kept from image to image.
  const Map* mapOf(const mrpt::img::TCamera& camera, int width, int height, std::unique_ptr<Map>& kept);

  std::unique_ptr<Map> depth_, picture_;
};

}  // namespace omnimapper::perception
