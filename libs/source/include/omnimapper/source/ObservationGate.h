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
/// beams and pixels without a return, and scans without beams, are no reason to refuse. Each log needs its own gate.
class ObservationGate {
 public:
  /// Why the observation cannot be used, as a clause about several such ones ("their aperture is not finite"); none if
  /// it can be used.
  std::optional<std::string> refuses(const mrpt::obs::CObservation& observation);

 private:
  using Size = std::pair<std::size_t, std::size_t>;  // columns and rows
  /// Sizes of a sensor's newest images. The most common size counts as the sensor's; of two equally common ones, the
  /// newer.
  using Sizes = std::deque<Size>;

  bool isOdd(const mrpt::obs::CObservation& observation, const Size& size);

  std::map<const mrpt::rtti::TRuntimeClassId*, std::map<std::string, Sizes>> sizes_;  // by class and label
};

/// Why an observation cannot be used regardless of the rest of the log; same form as ObservationGate::refuses().
std::optional<std::string> whyUnusable(const mrpt::obs::CObservation& observation);

}  // namespace omnimapper::source
