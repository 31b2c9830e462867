#include <omnimapper/base/Error.h>
#include <omnimapper/eval/RelativePoseError.h>

#include <algorithm>
#include <cmath>

#include "NamedChoice.h"

namespace omnimapper::eval {

namespace {

using base::Error;
using base::ExitCode;

// Position of each pair along the axis in which the delta is given: number, seconds or metres, rising.
std::vector<double> placesOnAxis(const std::vector<PosePair>& pairs, DeltaUnit unit) {
  std::vector<double> places(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    switch (unit) {
      case DeltaUnit::frames:
        places[i] = static_cast<double>(i);
        break;
      case DeltaUnit::seconds:
        places[i] = base::secondsBetween(pairs.front().stamp, pairs[i].stamp);
        break;
      case DeltaUnit::metres:
        places[i] = places[i - 1] + (pairs[i].reference.translation - pairs[i - 1].reference.translation).norm();
        break;
    }
  }
  return places;
}

// Index after `from` whose place is nearest to one delta later. `from` itself if that differs from the delta by more
// than a tenth, or by anything if frames are counted.
std::size_t oneDeltaLater(const std::vector<double>& places, std::size_t from, const Delta& delta) {
  const double wanted = places[from] + delta.value;
  const double tolerance = delta.unit == DeltaUnit::frames ? 0 : 0.1 * delta.value;
  const auto begin = places.begin() + static_cast<std::ptrdiff_t>(from);
  auto found = std::lower_bound(begin, places.end(), wanted);
  if (found == places.end() || (found != begin && wanted - *std::prev(found) <= *found - wanted)) --found;
  return std::abs(*found - wanted) <= tolerance ? static_cast<std::size_t>(found - places.begin()) : from;
}

void refuseBadDelta(const Delta& delta) {
  const bool is_whole = std::floor(delta.value) == delta.value;
  if (delta.value > 0 && std::isfinite(delta.value) && (delta.unit != DeltaUnit::frames || is_whole)) return;
  throw Error(ExitCode::out_of_range, "delta = " + std::to_string(delta.value) +
                                          " is out of range: it must be > 0, and a whole number if it counts frames");
}

}  // namespace

DeltaUnit deltaUnitNamed(const std::string& name) {
  return namedChoice<DeltaUnit>(name, "unit",
                                {{"frames", DeltaUnit::frames}, {"s", DeltaUnit::seconds}, {"m", DeltaUnit::metres}});
}

RelativePoseError relativePoseError(const Trajectory& estimate, const Trajectory& reference,
                                    const PairingOptions& options, const Delta& delta) {
  refuseBadDelta(delta);
  const PairedTrajectories paired = pairTrajectories(estimate, reference, options);
  const auto& pairs = paired.pairs;
  const std::vector<double> places = placesOnAxis(pairs, delta.unit);
  RelativePoseError result;
  result.unpaired = paired.unpaired;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t j = oneDeltaLater(places, i, delta);
    if (j == i) continue;
    const geometry::Vector6d error =
        minus(inverse(pairs[i].estimate) * pairs[j].estimate, inverse(pairs[i].reference) * pairs[j].reference);
    result.stamps.push_back(pairs[i].stamp);
    result.translation_errors.push_back(error.head<3>().norm());
    result.rotation_errors.push_back(error.tail<3>().norm());
  }
  if (result.stamps.empty()) {
    throw Error(ExitCode::unreadable_input, "no two of the " + std::to_string(pairs.size()) +
                                                " paired poses are one delta apart; choose a smaller delta");
  }
  result.translation = statisticsOf(result.translation_errors);
  result.rotation = statisticsOf(result.rotation_errors);
  return result;
}

}  // namespace omnimapper::eval
