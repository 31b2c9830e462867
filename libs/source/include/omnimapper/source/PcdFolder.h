#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/source/ObservationSource.h>
#include <omnimapper/source/PcdCloud.h>

#include <string>
#include <vector>

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

/// Streams the clouds of a folder of PCD files, in the order of their names: organised ones as depthImageOf() makes of
/// them, others as cloudOf() does, sensorPose the base's own pose (x forward, z up). Where all names are Unix times, in
/// seconds or nanoseconds, they are the stamps.
class PcdFolder : public ObservationSource {
 public:
  /// Throws Error(unreadable_input) for a folder without PCD files.
  explicit PcdFolder(const std::string& folder, const PcdFolderOptions& options = {});

  /// Files that are no cloud, and organised ones that no camera has seen so, are left out and counted as missing
  /// images.
  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }
  bool areNamesTimes() const { return !times_.empty(); }
  /// How many of those that were handed out have no rows and columns.
  std::size_t unorganised() const { return unorganised_; }

 private:
  PcdFolderOptions options_;
  std::vector<std::string> files_;
  std::vector<double> times_;  // Unix times of the files, where their names are such
  std::size_t next_ = 0, unorganised_ = 0;
  SourceReport report_;
};

}  // namespace omnimapper::source
