#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/Batch.h>
#include <omnimapper/mapper/View.h>

namespace omnimapper::mapper {

/// Turns observations into factors (thesis 5.3.3). One thread calls it; it keeps what it needs of what it has seen.
class MeasurementPlugin {
 public:
  virtual ~MeasurementPlugin() = default;
  /// Whether this observation, raw or derived, is of its kind. Depends on nothing but the observation.
  virtual bool wants(const mrpt::obs::CObservation& observation) const = 0;
  /// Whether its factors say where in the map the base is. The first pose is then not held at the origin.
  virtual bool givesAbsolutePoses() const { return false; }
  /// `frame` is the newest key frame, already linked to the one before; `observation` is one of its observations.
  virtual Batch measure(const map::KeyFrame& frame, const mrpt::obs::CObservation& observation, const View& view) = 0;
  /// The final ids of what its last batch added, in the order it was added.
  virtual void applied(const AppliedBatch& /*ids*/) {}
  /// After all batches of `frame` were applied, and after the solve if there was one.
  virtual Batch afterCommit(const map::KeyFrame& /*frame*/, const View& /*view*/) { return {}; }
};

}  // namespace omnimapper::mapper
