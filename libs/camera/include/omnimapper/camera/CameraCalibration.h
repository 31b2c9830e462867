#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/DepthDistortion.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::camera {

/// Section [calibration] of an INI file: a calibration of a depth camera, which replaces the calibration in the
/// camera's observations. Numbers that the section does not give stay as they are in the log.
struct CameraCalibrationOptions {
  using Number = std::optional<double>;
  std::string label;  ///< label of the camera's observations; empty: every depth camera

  Number depth_fx, depth_fy, depth_cx, depth_cy;                      ///< [px]
  Number depth_k1, depth_k2, depth_p1, depth_p2, depth_k3;            ///< lens, as OpenCV and MRPT's plumb_bob have it
  Number picture_fx, picture_fy, picture_cx, picture_cy;              ///< [px]
  Number picture_k1, picture_k2, picture_p1, picture_p2, picture_k3;  ///< lens
  Number depth_scale;                                                 ///< [-] true depth / depth in the log
  bool depth_is_range = false;                                        ///< the depth image holds distances
  bool mirrored = false;                                              ///< left and right are exchanged
  std::vector<std::string> depth_distortion;  ///< coefficients of DepthDistortion [1/m], each as text
  /// The pose depth_from_picture, defined as MRPT's relativePoseIntensityWRTDepth: the picture's frame is optical (x
  /// right, y down, z forward) while the depth camera's frame is not (x forward, y left, z up). [m] and [rad],
  /// rotations about z, then y, then x.
  Number picture_x, picture_y, picture_z, picture_yaw, picture_pitch, picture_roll;

  static const base::OptionTable<CameraCalibrationOptions>& table();
};

/// A calibration that replaces the one that a depth camera has in a log.
class CameraCalibration {
 public:
  /// A calibration that changes nothing.
  CameraCalibration() = default;
  /// Throws Error(out_of_range) for a pose of the picture that is only partly given and for coefficients that
  /// DepthDistortion refuses, and Error(wrong_type) for coefficients that are not numbers.
  explicit CameraCalibration(const CameraCalibrationOptions& options);
  /// Reads the section [calibration] of `config`; without that section the calibration changes nothing.
  static CameraCalibration read(const base::Config& config);

  /// Whether this calibration changes observations with the label `label`.
  bool isOf(const std::string& label) const { return is_set_ && (options_.label.empty() || options_.label == label); }
  const std::string& label() const { return options_.label; }
  const DepthDistortion& depthDistortion() const { return depth_distortion_; }
  /// Replaces the intrinsics of the cameras, their relative pose and the unit of the depths. A depth distortion is
  /// corrected first, in the log's units of depth; without a depth distortion the pixels of the depth image stay as
  /// they are, unless the images are mirrored back. Thread-safe.
  void applyTo(mrpt::obs::CObservation3DRangeScan& scan) const;

 private:
  CameraCalibrationOptions options_;
  DepthDistortion depth_distortion_;
  bool is_set_ = false;
};

}  // namespace omnimapper::camera
