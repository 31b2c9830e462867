#pragma once

#include <mrpt/obs/CObservation.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::perception {

/// Type and label, which distinguish derived observations of one stamp.
struct DerivedName {
  const mrpt::rtti::TRuntimeClassId* type;
  std::string label;
};

/// Decides which observations show something new, so that extracting from them is worth the time. It is asked by one
/// thread, in the order of the log.
class Novelty {
 public:
  virtual ~Novelty() = default;
  /// False if `raw` shows the same as the last new observation of its sensor, so that what was derived from that one
  /// holds for `raw` except for the stamp. `raw` is an observation that the extractor wants.
  virtual bool isNew(const mrpt::obs::CObservation& raw) = 0;
};

/// Perception: raw observation in, derived observations out. Pure: called from several threads at once.
class Extractor {
 public:
  virtual ~Extractor() = default;
  virtual bool wants(const mrpt::obs::CObservation& raw) const = 0;
  /// Derived observations with the stamp of `raw`, in their own sensor frame. `raw` has its final sensorPose.
  virtual std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const = 0;
  /// Names of what extract() would make of `raw`, without making it. If the log has all of these observations already,
  /// extract() is not called; if there are no names, it always is.
  virtual std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& /*raw*/) const { return {}; }
  /// Decides for one log what is new; none if every observation is to be extracted from. The mapper has its trigger
  /// instead.
  virtual std::unique_ptr<Novelty> novelty() const { return nullptr; }
  /// What a user should know, at the end, about all that was extracted. Does not depend on the order of extraction.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace omnimapper::perception
