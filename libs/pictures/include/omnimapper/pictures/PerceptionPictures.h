#pragma once

#include <mrpt/obs/CObservation.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::pictures {

/// Writes pictures of what perception found. Planes, objects, points, markers and signs are drawn over the image of a
/// range camera, markers and signs over that of another camera, and lines over a laser scan seen from above. The
/// pictures are PNG files in one folder, named after sensor and stamp.
class PerceptionPictures {
 public:
  /// For each sensor, counts the observations from which something was derived, and draws the first and then one in
  /// `every` of them. Creates the folder. Throws Error(unwritable_output).
  PerceptionPictures(const std::string& folder, int every);
  /// Removes the folder if this object created it and it is empty.
  ~PerceptionPictures();
  PerceptionPictures(const PerceptionPictures&) = delete;
  PerceptionPictures& operator=(const PerceptionPictures&) = delete;

  /// Draws the observations `derived` over the observation `raw`. If `derived` is empty or `raw` is of a kind that
  /// cannot be drawn, no picture is written or counted.
  void add(const mrpt::obs::CObservation& raw, const std::vector<mrpt::obs::CObservation::Ptr>& derived);

  int count() const { return count_; }

 private:
  std::string folder_;
  int every_, count_ = 0;
  bool is_new_;                      // this object created the folder
  std::map<std::string, int> seen_;  // number of observations from which something was derived, by label
};

}  // namespace omnimapper::pictures
