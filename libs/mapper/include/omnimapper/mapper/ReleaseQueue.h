#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>

#include <map>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// Sorts observations by stamp and holds each until the newest stamp is a window later, so that slower sensors find
/// their place (thesis 5.2.3.2). Observations of one stamp leave together, in order of arrival.
class ReleaseQueue {
 public:
  struct Group {
    base::Stamp stamp;
    std::vector<mrpt::obs::CObservation::Ptr> observations;
  };

  explicit ReleaseQueue(base::Duration window) : window_(window) {}

  /// False if its stamp was released already: it comes too late.
  bool add(const mrpt::obs::CObservation::Ptr& observation);
  /// Time goes on, also by observations that are not queued.
  void advanceTo(base::Stamp stamp);
  /// The next group that has waited long enough; with `drain` the next one at all.
  std::optional<Group> next(bool drain);
  std::size_t size() const { return groups_.size(); }

 private:
  base::Duration window_;
  std::map<base::Stamp, std::vector<mrpt::obs::CObservation::Ptr>> groups_;
  std::optional<base::Stamp> newest_, released_;
};

}  // namespace omnimapper::mapper
