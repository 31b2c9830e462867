#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/source/RawlogWriter.h>

#include <memory>
#include <optional>

namespace omnimapper::sim {

/// Writes measurements into a rawlog, in one of its two formats.
class LogWriter {
 public:
  virtual ~LogWriter() = default;
  virtual void add(const mrpt::obs::CObservation::Ptr& observation) = 0;
  /// To be called after the last observation.
  virtual void finish() {}
};

/// With Format::frames, the observations that arrive between two odometry readings form a frame, and the action before
/// it is the motion since the previous frame. Readings without observations between them are merged.
std::unique_ptr<LogWriter> makeLogWriter(SimulationOptions::Format format, source::RawlogWriter& rawlog);

}  // namespace omnimapper::sim
