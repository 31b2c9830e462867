#pragma once

#include <mrpt/obs/CObservation.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::perception {

/// What tells derived observations of one stamp apart.
struct DerivedName {
  const mrpt::rtti::TRuntimeClassId* type;
  std::string label;
};

/// Tells what is worth an extractor's time from what shows nothing new. One thread asks it, in the order of the log.
class Novelty {
 public:
  virtual ~Novelty() = default;
  /// False if `raw` shows what the last observation of its sensor showed for which this was true, so that what was
  /// derived of that one holds for `raw`, but for the stamp. `raw` is one that the extractor wants.
  virtual bool isNew(const mrpt::obs::CObservation& raw) = 0;
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
  /// For one log; none if every observation is worth its time. A mapper has its trigger instead.
  virtual std::unique_ptr<Novelty> novelty() const { return nullptr; }
  /// At the end: what a user should know of all that was extracted. Does not depend on the order.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace omnimapper::perception
