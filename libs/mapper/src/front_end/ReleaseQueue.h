#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>

#include <map>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// Sorts observations by stamp and holds each until one arrives that is a window later, so that observations of slower
/// sensors are put in order (thesis 5.2.3.2). Observations of one stamp leave together, in order of arrival.
class ReleaseQueue {
 public:
  struct Group {
    base::Stamp stamp;
    std::vector<mrpt::obs::CObservation::Ptr> observations;
  };

  explicit ReleaseQueue(base::Duration window) : window_(window) {}

  /// False if a stamp as late as this was already released: the observation comes too late.
  bool add(const mrpt::obs::CObservation::Ptr& observation);
  /// Whether an observation with the same label, class and stamp is waiting.
  bool holds(const mrpt::obs::CObservation& observation) const;
  /// Must be called for each observation that arrives, queued or not. A single stamp that is far off has no effect
  /// beyond the next call.
  void arrived(base::Stamp stamp) { now_ = stamp; }
  /// Stamp of the observation that arrived last.
  std::optional<base::Stamp> now() const { return now_; }
  /// Stamp of the next group, if it has waited long enough.
  std::optional<base::Stamp> due() const;
  /// Removes and returns the next group, however long it has waited.
  std::optional<Group> next();
  /// Number of groups that wait.
  std::size_t size() const { return groups_.size(); }

 private:
  base::Duration window_;
  std::map<base::Stamp, std::vector<mrpt::obs::CObservation::Ptr>> groups_;
  std::optional<base::Stamp> now_, released_;
};

}  // namespace omnimapper::mapper
