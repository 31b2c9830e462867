#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <memory>
#include <optional>

namespace omnimapper::camera {

/// Removes the lens distortion from the images of one range camera (radial and tangential, or fisheye, in OpenCV's and
/// MRPT's models), so that they look as if taken by pinhole cameras with the same focal lengths and centres.
class LensStraightener {
 public:
  LensStraightener();
  ~LensStraightener();
  LensStraightener(const LensStraightener&) = delete;
  LensStraightener& operator=(const LensStraightener&) = delete;

  /// Returns a scan with undistorted images and cameras without distortion. An image stays as it is if its lens moves
  /// every pixel by less than a third of a pixel, or if its calibration is invalid; if this holds for all images,
  /// returns `scan` itself. A new scan has the stamp, the label and the poses of `scan`, but no points and no
  /// confidences. Pixels that the lens did not show have no depth and are black. Throws Error(missing_images) if the
  /// picture is in a file that cannot be read. Thread-safe.
  mrpt::obs::CObservation3DRangeScan::ConstPtr straightened(
      const mrpt::obs::CObservation3DRangeScan::ConstPtr& scan) const;

 private:
  struct Map;
  /// The undistortion map for a camera and an image size; null if the image stays as it is. `kept` keeps the map for
  /// the next images.
  static std::shared_ptr<const Map> mapOf(const mrpt::img::TCamera& camera, int width, int height,
                                          std::shared_ptr<const Map>& kept);

  mutable std::shared_ptr<const Map> depth_, picture_;  // read and replaced atomically
};

}  // namespace omnimapper::camera
