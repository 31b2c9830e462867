#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace omnimapper::source {

/// Passes usable observations only, so that later stages need not check whether a sensor pose, an aperture, intrinsics,
/// a motion or a covariance is finite and plausible, or whether a depth image has the usual size of its sensor. Single
/// beams or pixels without a return are no reason to refuse an observation, nor is a scan without beams. Each log needs
/// its own gate.
class ObservationGate {
 public:
  /// Why the observation cannot be used, as a clause about several such observations ("their aperture is not finite");
  /// none if it can be used.
  std::optional<std::string> refuses(const mrpt::obs::CObservation& observation);

 private:
  using Size = std::pair<std::size_t, std::size_t>;  // columns and rows
  /// Sizes of a sensor's newest images. The most common size counts as the sensor's size; of two equally common sizes,
  /// the newer one does.
  using Sizes = std::deque<Size>;

  bool isOdd(const mrpt::obs::CObservation& observation, const Size& size);

  std::map<const mrpt::rtti::TRuntimeClassId*, std::map<std::string, Sizes>> sizes_;  // by class and label
};

/// Why an observation cannot be used, regardless of the rest of the log; in the same form as
/// ObservationGate::refuses().
std::optional<std::string> whyUnusable(const mrpt::obs::CObservation& observation);

}  // namespace omnimapper::source
