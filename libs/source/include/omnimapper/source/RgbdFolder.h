#pragma once

#include <mrpt/img/TCamera.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/source/ObservationSource.h>

#include <cstddef>
#include <string>
#include <vector>

namespace omnimapper::source {

struct RgbdFolderOptions {
  std::string label = "RGBD";
  double largest_difference = 0.02;  ///< between the stamps of depth and colour that make a pair [s]
  double depth_units = 0;            ///< values of a depth image in a metre; 0: as is usual for the folder's form
  double rate = 30;                  ///< of images without stamps [1/s]
  /// freiburg1, freiburg2, freiburg3, icl_nuim, 7_scenes, openni, or a file that has fx, fy, cx and cy: four numbers,
  /// or OpenCV's "Camera.fx: 535.4". Empty: as the folder's form and name tell.
  std::string intrinsics;
};

/// A depth image with its colour image.
struct RgbdPair {
  base::Stamp stamp;          ///< of the depth image
  std::string depth, colour;  ///< paths
};

/// Streams a folder of depth and colour images, taken by a camera that sees both from one place, as
/// CObservation3DRangeScan: depth along the optical axis in rangeUnits, colour registered to it, sensorPose the base's
/// own pose (x forward, z up). The forms it knows:
///  - TUM RGB-D: depth.txt and rgb.txt with "stamp file" lines, groundtruth.txt with "stamp x y z qx qy qz qw";
///    stamps that are running numbers take those of truth_cam_poses.txt, line by line, if it is there;
///  - pairs of equal names: depth/0001.png with image/ or rgb/0001.jpg (ICL-NUIM), without stamps;
///  - 7-Scenes: frame-000001.depth.png, .color.png, .pose.txt (4 x 4 matrix).
class RgbdFolder : public ObservationSource {
 public:
  /// Throws Error(unreadable_input) if the folder is of no known form, a list cannot be read or intrinsics are missing.
  explicit RgbdFolder(const std::string& folder, const RgbdFolderOptions& options = {});

  /// Pairs whose images cannot be read are left out and counted as missing images.
  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }

  /// In order of their stamps.
  const std::vector<RgbdPair>& pairs() const { return pairs_; }
  /// Depth images without a colour image of their time.
  std::size_t unpaired() const { return unpaired_; }
  /// True poses of the base in the folder's world, as far as it tells them: stamp and pose, in order.
  const std::vector<std::pair<base::Stamp, geometry::Se3>>& groundTruth() const { return ground_truth_; }

 private:
  RgbdFolderOptions options_;
  mrpt::img::TCamera camera_;
  std::vector<RgbdPair> pairs_;
  std::vector<std::pair<base::Stamp, geometry::Se3>> ground_truth_;
  std::size_t unpaired_ = 0, next_ = 0;
  SourceReport report_;
};

}  // namespace omnimapper::source
