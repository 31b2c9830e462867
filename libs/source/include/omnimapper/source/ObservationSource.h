#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/source/SourceReport.h>

namespace omnimapper::source {

/// A stream of observations. A live driver fits: next() waits for what mrpt::hwdrivers' getObservations() hands out.
class ObservationSource {
 public:
  virtual ~ObservationSource() = default;
  /// The next observation, the caller's own; null at the end. Damaged input throws nothing: the stream ends, and
  /// report() says why. What an observation keeps in external files is loaded.
  virtual mrpt::obs::CObservation::Ptr next() = 0;
  /// Part of the input that has been read, in [0, 1].
  virtual double progress() const = 0;
  virtual SourceReport report() const = 0;
  /// From another thread, before this source is given up: a next() that waits for something returns null soon.
  virtual void interrupt() {}
};

}  // namespace omnimapper::source
