#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/source/FolderSource.h>
#include <omnimapper/source/PcdCloud.h>

#include <string>

namespace omnimapper::source {

struct PcdFolderOptions {
  std::string label = "RGBD";
  double rate = 30;  ///< of clouds whose names are no Unix times [1/s]
};

/// The depth image, with colours where it has any, of an organised cloud in a camera's optical frame (x right, y down,
/// z forward): which ray belongs to which pixel is told by the points themselves. Depth is kept in steps of 0.1 mm, up
/// to 6.5 m. Throws Error(unreadable_input), with `name` in it, for a cloud that no pinhole camera has seen so.
mrpt::obs::CObservation3DRangeScan::Ptr depthImageOf(const PcdCloud& cloud, const std::string& name);

/// The points of any other cloud, without their colours, in the frame that they are in: a CObservationPointCloud.
mrpt::obs::CObservation::Ptr cloudOf(const PcdCloud& cloud);

/// The clouds of a folder of PCD files: organised ones as depthImageOf() makes of them, others as cloudOf() does,
/// sensorPose the base's own pose (x forward, z up). Files that are no cloud, and organised ones that no camera has
/// seen so, are left out.
class PcdFolder : public FolderSource {
 public:
  /// Throws Error(unreadable_input) for a folder without PCD files.
  explicit PcdFolder(const std::string& folder, const PcdFolderOptions& options = {});

  /// How many of those that were handed out have no rows and columns.
  std::size_t unorganised() const { return unorganised_; }

 private:
  mrpt::obs::CObservation::Ptr read(const std::string& file) override;

  std::size_t unorganised_ = 0;
};

}  // namespace omnimapper::source
