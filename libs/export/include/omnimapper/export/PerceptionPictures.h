#pragma once

#include <mrpt/obs/CObservation.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::exports {

/// Writes pictures of what perception found: planes, objects, points and markers over the image of a range camera,
/// markers over that of another camera, lines over a laser scan seen from above. They are PNG files in one folder,
/// named after sensor and stamp.
class PerceptionPictures {
 public:
  /// Draws every `every`-th observation of each sensor, beginning with the first. Creates the folder. Throws
  /// Error(unwritable_output).
  PerceptionPictures(const std::string& folder, int every);
  /// Removes the folder if it was created here and is empty.
  ~PerceptionPictures();
  PerceptionPictures(const PerceptionPictures&) = delete;
  PerceptionPictures& operator=(const PerceptionPictures&) = delete;

  /// Draws the observations `derived` from `raw`. If there are none, or none that can be drawn, no picture is written
  /// or counted.
  void add(const mrpt::obs::CObservation& raw, const std::vector<mrpt::obs::CObservation::Ptr>& derived);

  int count() const { return count_; }

 private:
  std::string folder_;
  int every_, count_ = 0;
  bool is_new_;                      // the folder was created here
  std::map<std::string, int> seen_;  // number of observations by label
};

}  // namespace omnimapper::exports
