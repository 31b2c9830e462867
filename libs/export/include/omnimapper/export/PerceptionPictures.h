#pragma once

#include <mrpt/obs/CObservation.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::exports {

/// Pictures of what perception found, to be looked at: planes, objects, points and markers over the image of a range
/// camera, markers over that of another camera, lines over a laser scan seen from above. PNG files in one folder, named
/// after sensor and stamp.
class PerceptionPictures {
 public:
  /// Of each sensor every so manieth observation, the first included. Makes the folder. Throws
  /// Error(unwritable_output).
  PerceptionPictures(const std::string& folder, int every);
  /// Leaves no empty folder behind that it made.
  ~PerceptionPictures();
  PerceptionPictures(const PerceptionPictures&) = delete;
  PerceptionPictures& operator=(const PerceptionPictures&) = delete;

  /// What was derived of `raw`. Where that is nothing, or nothing that can be drawn, there is no picture, and it does
  /// not count.
  void add(const mrpt::obs::CObservation& raw, const std::vector<mrpt::obs::CObservation::Ptr>& derived);

  int count() const { return count_; }

 private:
  std::string folder_;
  int every_, count_ = 0;
  bool is_new_;                      // the folder
  std::map<std::string, int> seen_;  // by label
};

}  // namespace omnimapper::exports
