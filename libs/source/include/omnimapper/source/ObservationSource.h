#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/source/SourceReport.h>

#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::source {

/// Poses of the base in a world frame, in order of stamps.
using TruePoses = std::vector<std::pair<base::Stamp, geometry::Se3>>;

/// A stream of observations. A live driver can implement it too: next() then waits for data of getObservations() in
/// mrpt::hwdrivers.
class ObservationSource {
 public:
  virtual ~ObservationSource() = default;
  /// The next observation, owned by the caller; null at the end. Damaged input does not throw: the stream ends, and
  /// report() says why. Data in external files is loaded.
  virtual mrpt::obs::CObservation::Ptr next() = 0;
  /// Share of the input that has been read, in [0, 1].
  virtual double progress() const = 0;
  virtual SourceReport report() const = 0;
  /// Another thread calls this before it gives the source up; a call of next() that is waiting then returns null soon.
  virtual void interrupt() {}
  /// The true poses that the log has beside its observations; empty if it has none.
  virtual TruePoses truth() const { return {}; }
  /// The true pose at a time; none if the log has none that is near enough.
  virtual std::optional<geometry::Se3> truthAt(base::Stamp /*stamp*/) const { return std::nullopt; }
};

}  // namespace omnimapper::source
