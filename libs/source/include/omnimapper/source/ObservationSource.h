#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/source/SourceReport.h>

namespace omnimapper::source {

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
};

}  // namespace omnimapper::source
