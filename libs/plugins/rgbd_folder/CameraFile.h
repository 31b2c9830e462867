#pragma once

#include <mrpt/img/TCamera.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::source {

/// The camera that a file describes: a pinhole with fx, fy, cx, cy [px] and the lens (k1, k2, p1, p2, k3 and k4 to k6
/// of OpenCV's model).
struct CameraFile {
  std::string path;
  mrpt::img::TCamera camera;     ///< ncols and nrows are 0 if the file does not state the size of the images
  double depth_units_per_m = 0;  ///< ORB-SLAM's DepthMapFactor; 0 if the file has none
};

/// Reads a file of one of these forms:
///  - fx, fy, cx, cy (or ppx, ppy) by name, as "Camera.fx: 535.4", "fx = 535.4" or "\"fx\": 535.4", and k1, k2, p1, p2,
///    k3 likewise;
///  - camera_info.yaml of ROS, or what camera_calibration writes: camera_matrix and distortion_coefficients;
///  - a CameraInfo of ROS as JSON or YAML: K and D, or k and d;
///  - Open3D's JSON: intrinsic_matrix, column by column;
///  - four numbers fx, fy, cx, cy, the nine of the matrix K row by row, or the sixteen of the same matrix with a fourth
///    row and column.
/// None if the file states no camera. Throws Error(unreadable_input) if it states several, a lens that is not read, or
/// a matrix that is none of a camera.
std::optional<CameraFile> readCameraFile(const std::string& path);

/// The camera that the files beside images state: those of `folders`, whose names end in .json, .yaml or .yml, or in
/// .txt and have "intrin", "calib", "camera" or "K" in them. None if no file states one. Throws Error(unreadable_input)
/// if a file cannot be used, or if two state different cameras.
std::optional<CameraFile> cameraFileIn(const std::vector<std::string>& folders);

}  // namespace omnimapper::source
