#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/calibration/DepthRun.h>
#include <omnimapper/source/SourceReport.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "DepthCells.h"

namespace omnimapper::calibration {

/// Keeps depth images that differ from one another, spread over a log of any length.
class DepthImageChooser {
 public:
  /// Keeps at most `most` images, and at least half as many if there were more.
  explicit DepthImageChooser(std::size_t most) : most_(most) {}

  /// Adds an image. An image of another size than the first, or that cannot be read, is left out.
  void add(const mrpt::obs::CObservation3DRangeScan& scan);
  std::vector<DepthCells> take();

  std::size_t images() const { return images_; }
  std::size_t leftOut() const { return left_out_; }
  const std::string& whyLeftOut() const { return why_left_out_; }  ///< reason for the first one

 private:
  void leaveOut(const std::string& why);

  std::size_t most_, stride_ = 1, different_ = 0, images_ = 0, left_out_ = 0;
  std::string why_left_out_;
  DepthCells last_;               // last image that differed from the one before
  std::vector<DepthCells> kept_;  // every stride_-th of these
};

/// The data of a log from which the distortion of its depth camera is estimated.
struct DepthLog {
  std::string label;  ///< of the camera
  std::vector<DepthCells> images;
  std::size_t scans = 0, left_out = 0;
  std::string why_left_out;  ///< reason for the first one
  /// Keys and values of [calibration] in the request's INI, as written, if it is of this camera. They were applied to
  /// the depths.
  std::vector<std::pair<std::string, std::string>> ini_values;
  std::vector<double> ini_distortion;  ///< depth_distortion_per_m of that INI
  double ini_scale = 1;                ///< depth_scale of that INI
  source::SourceReport report;
};

/// Throws Error(nothing_to_map) if the log has no depth image that can be used, and Error(interrupted).
DepthLog readDepthLog(const DepthRequest& request, base::Progress& progress, const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
