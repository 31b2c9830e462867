#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/DepthDistortion.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::perception {

/// Section [calibration] of an INI file: what holds of a camera with depths instead of what its observations say. A
/// number that the section does not name stays as the log has it.
struct CameraCalibrationOptions {
  using Number = std::optional<double>;
  std::string label;  ///< of the observations; empty: of every camera with depths

  Number depth_fx, depth_fy, depth_cx, depth_cy;                      ///< [px]
  Number depth_k1, depth_k2, depth_p1, depth_p2, depth_k3;            ///< lens, as OpenCV and MRPT's plumb_bob have it
  Number picture_fx, picture_fy, picture_cx, picture_cy;              ///< [px]
  Number picture_k1, picture_k2, picture_p1, picture_p2, picture_k3;  ///< lens
  Number depth_scale;                                                 ///< true depth over the log's
  std::vector<std::string> depth_distortion;  ///< coefficients of DepthDistortion [1/m], in numbers as they are written
  /// depth_from_picture as MRPT has it in relativePoseIntensityWRTDepth, whose picture's frame is optical (x right, y
  /// down, z forward) while the depth camera's is not (x forward, y left, z up). [m] [rad], about z, then y, then x.
  Number picture_x, picture_y, picture_z, picture_yaw, picture_pitch, picture_roll;

  static const base::OptionTable<CameraCalibrationOptions>& table();
};

/// A calibration of a camera with depths in the place of that which a log brings.
class CameraCalibration {
 public:
  /// Changes nothing.
  CameraCalibration() = default;
  /// Throws Error(out_of_range) for a pose of the picture of which only a part is told, and for a distortion of the
  /// depths that DepthDistortion refuses, Error(wrong_type) for one that is no numbers.
  explicit CameraCalibration(const CameraCalibrationOptions& options);
  /// Of [calibration] of `config`; without that section it changes nothing.
  static CameraCalibration read(const base::Config& config);

  /// Whether it changes observations of that label.
  bool isOf(const std::string& label) const { return tells_ && (options_.label.empty() || options_.label == label); }
  const std::string& label() const { return options_.label; }
  const DepthDistortion& depthDistortion() const { return depth_distortion_; }
  /// Changes the cameras, their places and the units of the depths. The depth image stays as it is without a
  /// distortion of the depths; with one it is corrected first, as the log tells it, and then scaled. Thread-safe.
  void applyTo(mrpt::obs::CObservation3DRangeScan& scan) const;

 private:
  CameraCalibrationOptions options_;
  DepthDistortion depth_distortion_;
  bool tells_ = false;
};

}  // namespace omnimapper::perception
