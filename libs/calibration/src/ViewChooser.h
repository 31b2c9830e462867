#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/calibration/DepthCamera.h>
#include <omnimapper/matching/RgbdTracker.h>
#include <omnimapper/perception/LensStraightener.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "CalibrationView.h"

namespace omnimapper::calibration {

/// Follows a camera by its images and keeps some of them: evenly along its way and its turning, and of those near one
/// another the one in which it turned most slowly, for a shutter that reads row by row bends fast ones.
class ViewChooser {
 public:
  /// `most` views at the end.
  explicit ViewChooser(std::size_t most) : most_(most), tracker_({}, {}, {}) {}

  /// An image with depths and picture; one of another size than the first, or that cannot be read, is left out.
  void add(const mrpt::obs::CObservation3DRangeScan::ConstPtr& scan);
  /// The views in the order of time. To be called once, at the end.
  std::vector<CalibrationView> take();

  /// Whether there are so many views that more of the log would only take them farther apart than they can be matched.
  bool isFull() const { return spacing_ >= kWidestSpacing && kept_.size() > most_; }
  const std::optional<DepthCamera>& camera() const { return camera_; }
  std::size_t images() const { return images_; }
  std::size_t lost() const { return lost_; }
  /// Images that were left out, and why the first was.
  std::size_t leftOut() const { return left_out_; }
  const std::string& whyLeftOut() const { return why_left_out_; }
  /// How far the camera went [m] and turned [rad], all in all.
  double travel() const { return travel_; }
  double turn() const { return turn_; }

 private:
  struct Candidate {
    CalibrationView view;
    std::size_t bin;
  };
  void leaveOut(const std::string& why);
  void follow(const mrpt::obs::CObservation3DRangeScan::ConstPtr& scan);
  void thin();

  static constexpr double kWidestSpacing = 4;  // 16 degrees or 0.32 m

  std::size_t most_;
  matching::RgbdTracker tracker_;
  perception::LensStraightener lens_;
  std::optional<DepthCamera> camera_;
  std::vector<Candidate> kept_;
  std::size_t images_ = 0, lost_ = 0, left_out_ = 0;
  std::string why_left_out_;
  double travel_ = 0, turn_ = 0;
  double spacing_ = 1;  // of bins, in units of motion
  int stretch_ = 0;
};

}  // namespace omnimapper::calibration
