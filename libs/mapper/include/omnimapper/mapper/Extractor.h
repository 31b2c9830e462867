#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Perception: raw observation in, derived observations out. Pure: called from several threads at once.
class Extractor {
 public:
  virtual ~Extractor() = default;
  virtual bool wants(const mrpt::obs::CObservation& raw) const = 0;
  /// Derived observations with the stamp of `raw`, in their own sensor frame. `raw` has its final sensorPose.
  virtual std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const = 0;
};

}  // namespace omnimapper::mapper
