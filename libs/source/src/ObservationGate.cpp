#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/source/ObservationGate.h>

#include <algorithm>

namespace omnimapper::source {

using namespace mrpt::obs;

namespace {

// Columns and rows of a depth image; none for other observations.
std::optional<std::pair<std::size_t, std::size_t>> sizeOf(const CObservation& observation) {
  const auto* image = dynamic_cast<const CObservation3DRangeScan*>(&observation);
  if (image && image->hasRangeImage)
    return std::pair{static_cast<std::size_t>(image->rangeImage.cols()),
                     static_cast<std::size_t>(image->rangeImage.rows())};
  return std::nullopt;
}

}  // namespace

std::optional<std::string> ObservationGate::refuses(const CObservation& observation) {
  if (auto reason = whyUnusable(observation)) return reason;
  const auto size = sizeOf(observation);
  if (size && isOdd(observation, *size)) return "their size is not that of the sensor's other images";
  return std::nullopt;
}

// A sensor may be set to another size: that becomes its size once half of the newest images have it.
bool ObservationGate::isOdd(const CObservation& observation, const Size& size) {
  constexpr std::size_t kRemembered = 10;
  auto& sizes = sizes_[observation.GetRuntimeClass()][observation.sensorLabel];
  sizes.push_back(size);
  if (sizes.size() > kRemembered) sizes.pop_front();
  const auto count = [&](const Size& one) { return std::count(sizes.begin(), sizes.end(), one); };
  return std::any_of(sizes.begin(), sizes.end(), [&](const Size& other) { return count(other) > count(size); });
}

}  // namespace omnimapper::source
