#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>

#include <map>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// Sorts observations by stamp and holds each until one arrives that is a window later, so that slower sensors find
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
  /// Whether one of that label, class and stamp waits already.
  bool holds(const mrpt::obs::CObservation& observation) const;
  /// An observation of that stamp has arrived, queued or not. A single stamp from far off is forgotten with the next.
  void arrived(base::Stamp stamp) { now_ = stamp; }
  /// Stamp of what arrived last.
  std::optional<base::Stamp> now() const { return now_; }
  /// Stamp of the next group, if it has waited long enough.
  std::optional<base::Stamp> due() const;
  /// The next group, however long it has waited.
  std::optional<Group> next();
  /// Of the groups that wait.
  std::size_t size() const { return groups_.size(); }

 private:
  base::Duration window_;
  std::map<base::Stamp, std::vector<mrpt::obs::CObservation::Ptr>> groups_;
  std::optional<base::Stamp> now_, released_;
};

}  // namespace omnimapper::mapper
