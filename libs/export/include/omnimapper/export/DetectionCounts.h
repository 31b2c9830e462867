#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::exports {

/// How many planes, lines, things, signs, markers or points perception found, by label.
class DetectionCounts {
 public:
  void add(const std::vector<mrpt::obs::CObservation::Ptr>& derived);

  /// A line for each label: "  kinect.planes: 113 planes in 16 observations". What is of no known class is counted as
  /// observations alone.
  std::string text() const;

 private:
  struct Count {
    std::string what;  ///< "planes"
    std::size_t observations = 0, found = 0;
  };
  std::map<std::string, Count> of_label_;
};

}  // namespace omnimapper::exports
