#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/FolderSource.h>
#include <omnimapper/source/LogLook.h>

#include <string>

#include "PcdCloud.h"

namespace omnimapper::source {

struct PcdFolderOptions {
  std::string label = "RGBD";
  double rate = 30;  ///< clouds per second, if their names are no Unix times [1/s]
  static const base::OptionTable<PcdFolderOptions>& table();
};

/// Converts an organized cloud in a camera's optical frame (x right, y down, z forward) to a depth image, with colours
/// if the cloud has them. The intrinsics are fitted to the points. Depth is kept in steps of 0.1 mm, up to 6.5 m.
/// Throws Error(unreadable_input), with `name` in it, if the points do not lie on the rays of a pinhole camera.
mrpt::obs::CObservation3DRangeScan::Ptr depthImageOf(const PcdCloud& cloud, const std::string& name);

/// Converts a cloud that is not organized to a CObservationPointCloud in the frame of its points, without colours.
mrpt::obs::CObservation::Ptr cloudOf(const PcdCloud& cloud);

/// Streams the PCD files of a folder: organized clouds by depthImageOf(), others by cloudOf(), with sensorPose at the
/// base (x forward, z up). Files that are no cloud, and organized clouds that depthImageOf() refuses, are left out.
class PcdFolder : public FolderSource {
 public:
  static constexpr const char* kName = "pcd_folder";
  static constexpr const char* kSummary = "a folder of PCD clouds";
  static bool recognizes(const LogLook& look);

  /// Throws Error(unreadable_input) for a folder without PCD files.
  explicit PcdFolder(const std::string& folder, const PcdFolderOptions& options = {});

  /// Number of clouds handed out that are not organized in rows and columns.
  std::size_t unorganized() const { return unorganized_; }

 private:
  mrpt::obs::CObservation::Ptr read(const std::string& file) override;
  void noteAtEnd(SourceReport& report) const override;

  std::size_t unorganized_ = 0;
};

}  // namespace omnimapper::source
