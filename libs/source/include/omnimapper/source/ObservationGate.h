#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace omnimapper::source {

/// Passes observations that something can be made of: what stands behind it need not ask again whether a sensor pose,
/// an aperture, intrinsics, a motion or a covariance is a number and makes sense, or whether a depth image is of
/// the size of the sensor's others. Single beams and pixels without a return, and scans without beams, are no reason to
/// refuse. One for each log.
class ObservationGate {
 public:
  /// Why it cannot be used, as a clause about several such observations ("their aperture is not finite"); none if it
  /// can be.
  std::optional<std::string> refuses(const mrpt::obs::CObservation& observation);

 private:
  using Size = std::pair<std::size_t, std::size_t>;  // columns and rows
  /// Of the newest observations of a sensor. The commonest is that of the sensor; of two equally common the newer.
  using Sizes = std::deque<Size>;

  bool isOdd(const mrpt::obs::CObservation& observation, const Size& size);

  std::map<const mrpt::rtti::TRuntimeClassId*, std::map<std::string, Sizes>> sizes_;  // by class and label
};

/// Why it cannot be used whatever else the log holds, as refuses().
std::optional<std::string> whyUnusable(const mrpt::obs::CObservation& observation);

}  // namespace omnimapper::source
