#pragma once

#include <mrpt/img/TCamera.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/ObservationSource.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::source {

struct RgbdFolderOptions {
  std::string label = "RGBD";
  double largest_difference = 0.02;  ///< [s] largest difference between the stamps of a pair's depth and colour image
  double depth_units = 0;            ///< depth values per metre; 0: as usual for the form of the folder, see RgbdFolder
  double rate = 30;                  ///< images per second, if they have no stamps [1/s]
  /// freiburg1, freiburg2, freiburg3, icl_nuim, 7_scenes, openni, or a file that CameraFile reads. Empty: as a file
  /// beside the images states, else determined by the folder's name.
  std::string intrinsics;
  static const base::OptionTable<RgbdFolderOptions>& table();
};

/// A depth image with its colour image, if it has one.
struct RgbdPair {
  base::Stamp stamp;          ///< of the depth image
  std::string depth, colour;  ///< paths; no colour: empty
};

/// Streams a folder of depth images and colour images registered to them as CObservation3DRangeScan: depth along the
/// optical axis in rangeUnits, sensorPose at the base (x forward, z up). Known forms of folders:
///  - TUM RGB-D: depth.txt and rgb.txt with "stamp file" lines, and groundtruth.txt with "stamp x y z qx qy qz qw"
///    lines. If there is truth_cam_poses.txt instead of groundtruth.txt, the stamps of the images are running numbers;
///    the stamps of the poses replace them line by line. 5000 depth values per metre.
///  - depth/ or depths/ with rgb/, color/, colour/, image/ or images/, whose images belong together if their names or,
///    if all are Unix times, their times agree; without such a folder depths alone; also a folder of nothing but depth
///    images. Names that are no times are in the order of their numbers. 5000 depth values per metre if the camera is
///    that of TUM or ICL-NUIM and the pictures are in rgb/, else 1000.
///  - associations.txt with lines "1 depth/1.png 1 rgb/1.png", where the numbers are running numbers or stamps (as
///    ICL-NUIM itself has them). 5000 depth values per metre.
///  - 7-Scenes: frame-000001.depth.png, .color.png or .color.jpg, and .pose.txt (4 x 4 matrix). 1000 depth values per
///    metre.
/// A depth image without a colour image of its time is handed out without colour. The camera is that of the option,
/// else that of a file in the folder or in its folder of depths (one folder above if the folder's name is depth, depths
/// or seq...), else that of the public data set that the folder's path names; it is never assumed.
class RgbdFolder : public ObservationSource {
 public:
  static constexpr const char* kName = "rgbd_folder";
  static constexpr const char* kSummary = "a folder of RGB-D images";
  static bool recognizes(const LogLook& look);

  /// Throws Error(unreadable_input) if the folder has no known form, a list cannot be read, or intrinsics are missing,
  /// contradictory or of images of another size.
  explicit RgbdFolder(const std::string& folder, const RgbdFolderOptions& options = {});

  /// Pairs whose images cannot be read are left out and counted as missing images.
  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }

  /// In order of the stamps.
  const std::vector<RgbdPair>& pairs() const { return pairs_; }
  /// Number of depth images without a colour image of their time.
  std::size_t unpaired() const { return unpaired_; }
  /// Intrinsics of both images [px], and the name or file that they come from.
  const mrpt::img::TCamera& camera() const { return camera_; }
  const std::string& cameraName() const { return camera_name_; }
  /// Values of a depth image per metre.
  double depthUnits() const { return options_.depth_units; }
  /// Median depth [m] of all pixels with a depth in the images that next() returned; none before the first image.
  std::optional<double> medianDepth() const;
  /// True poses of the base in the world frame of the folder.
  TruePoses truth() const override { return ground_truth_; }
  /// The true pose nearest in time; none if it is more than RgbdFolderOptions::largest_difference away.
  std::optional<geometry::Se3> truthAt(base::Stamp stamp) const override;

 private:
  void finish();

  RgbdFolderOptions options_;
  std::string camera_name_;
  mrpt::img::TCamera camera_;
  std::vector<RgbdPair> pairs_;
  TruePoses ground_truth_;
  std::size_t unpaired_ = 0, next_ = 0;
  std::vector<std::uint64_t> depth_counts_;  // number of pixels of each depth value
  SourceReport report_;
};

}  // namespace omnimapper::source
