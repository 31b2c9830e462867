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
  /// At most `most` images at the end, half as many at least where there were more.
  explicit DepthImageChooser(std::size_t most) : most_(most) {}

  /// One of another size than the first, or that cannot be read, is left out.
  void add(const mrpt::obs::CObservation3DRangeScan& scan);
  std::vector<DepthCells> take();

  std::size_t images() const { return images_; }
  std::size_t leftOut() const { return left_out_; }
  const std::string& whyLeftOut() const { return why_left_out_; }  ///< of the first

 private:
  void leaveOut(const std::string& why);

  std::size_t most_, stride_ = 1, different_ = 0, images_ = 0, left_out_ = 0;
  std::string why_left_out_;
  DepthCells last_;               // that differed
  std::vector<DepthCells> kept_;  // every stride_-th of these
};

/// What of a log tells how its camera bends planes.
struct DepthLog {
  std::string label;  ///< of the camera
  std::vector<DepthCells> images;
  std::size_t scans = 0, left_out = 0;
  std::string why_left_out;  ///< of the first
  /// [calibration] of the request's INI, key by key as written, where it is of this camera; it was applied.
  std::vector<std::pair<std::string, std::string>> told;
  std::vector<double> told_distortion;  ///< of these
  double told_scale = 1;
  source::SourceReport report;
};

/// Throws Error(nothing_to_map) where no depth image is in the log, and Error(interrupted).
DepthLog readDepthLog(const DepthRequest& request, base::Progress& progress, const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
