#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace omnimapper::perception {

/// What tells derived observations of one stamp apart.
struct DerivedName {
  const mrpt::rtti::TRuntimeClassId* type;
  std::string label;
};

/// Perception: raw observation in, derived observations out. Pure: called from several threads at once.
class Extractor {
 public:
  virtual ~Extractor() = default;
  virtual bool wants(const mrpt::obs::CObservation& raw) const = 0;
  /// Derived observations with the stamp of `raw`, in their own sensor frame. `raw` has its final sensorPose.
  virtual std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const = 0;
  /// What extract() would make of `raw`, without making it. Where a log brings all of that, it is not made anew; of
  /// what names nothing, everything is.
  virtual std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& /*raw*/) const { return {}; }
  /// At the end: what a user should know of all that was extracted. Does not depend on the order.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace omnimapper::perception
