#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/calibration/DepthCamera.h>
#include <omnimapper/camera/LensStraightener.h>
#include <omnimapper/matching/RgbdTracker.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "CalibrationView.h"

namespace omnimapper::calibration {

/// Tracks a camera by its images and keeps some of them, evenly spaced over the distance that it travels and the angle
/// that it turns. Of neighbouring images it keeps the one in which the camera turned most slowly, because a rolling
/// shutter distorts images of a fast rotation.
class ViewChooser {
 public:
  /// take() returns at most `most` views.
  explicit ViewChooser(std::size_t most) : most_(most), tracker_({}, {}, {}) {}

  /// Adds an image with depths and picture. An image of another size than the first, or that cannot be read, is left
  /// out.
  void add(const mrpt::obs::CObservation3DRangeScan::ConstPtr& scan);
  /// The views in the order of time; call it once, at the end.
  std::vector<CalibrationView> take();

  /// Whether there are enough views: more of the log would only increase their spacing, until they can no longer be
  /// matched.
  bool isFull() const { return spacing_ >= kWidestSpacing && kept_.size() > most_; }
  const std::optional<DepthCamera>& camera() const { return camera_; }
  std::size_t images() const { return images_; }
  std::size_t lost() const { return lost_; }
  /// Number of images that were left out, and the reason for the first one.
  std::size_t leftOut() const { return left_out_; }
  const std::string& whyLeftOut() const { return why_left_out_; }
  /// Total distance that the camera travelled [m] and angle that it turned [rad].
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
  camera::LensStraightener lens_;
  std::optional<DepthCamera> camera_;
  std::vector<Candidate> kept_;
  std::size_t images_ = 0, lost_ = 0, left_out_ = 0;
  std::string why_left_out_;
  double travel_ = 0, turn_ = 0;
  double spacing_ = 1;  // of bins, in units of motion
  int stretch_ = 0;
};

}  // namespace omnimapper::calibration
