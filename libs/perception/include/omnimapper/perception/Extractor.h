#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/perception/Blackboard.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::perception {

/// Type and label, which distinguish the derived observations with one stamp.
struct DerivedName {
  const mrpt::rtti::TRuntimeClassId* type;
  std::string label;
};

/// Decides which observations show something new, so that extracting from them is worth the time. One thread calls
/// isNew(), in the order of the log.
class Novelty {
 public:
  virtual ~Novelty() = default;
  /// False if `raw` shows the same as the last new observation of its sensor. What was derived from that observation
  /// then holds for `raw`, too, except for the stamp. `raw` is an observation that the extractor wants.
  virtual bool isNew(const mrpt::obs::CObservation& raw) = 0;
};

/// A stage of perception, which makes derived observations from a raw one. Several threads call its functions at once,
/// so the result must depend on the arguments alone.
class Extractor {
 public:
  virtual ~Extractor() = default;
  virtual bool wants(const mrpt::obs::CObservation& raw) const = 0;
  /// Derived observations with the stamp of `raw`, each in the frame of its own sensor pose. The sensor pose of `raw`
  /// is final.
  virtual std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const = 0;
  /// The same in a chain of extractors, which share a blackboard for `raw`: an extractor may use what is on it, and
  /// adds what others may use. Derived observations that an earlier extractor has made already are left out.
  virtual std::vector<mrpt::obs::CObservation::Ptr> extractUsing(const mrpt::obs::CObservation& raw,
                                                                 Blackboard& /*board*/) const {
    return extract(raw);
  }
  /// The names of the observations that extract() would make from `raw`, without making them. If the log already has
  /// all of these observations, extract() is not called; if there are no names, extract() is always called.
  virtual std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& /*raw*/) const { return {}; }
  /// An object that decides which observations of one log are new; null if extract() is to be called for every
  /// observation. Mapping does not use it, because the trigger decides there.
  virtual std::unique_ptr<Novelty> novelty() const { return nullptr; }
  /// Warnings for the user at the end of a run, about all that was extracted. They do not depend on the order of
  /// extraction.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace omnimapper::perception
