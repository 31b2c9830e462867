#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/source/RawlogWriter.h>

#include <memory>
#include <optional>

namespace omnimapper::sim {

/// Puts measurements into a rawlog, in one of its two forms.
class LogWriter {
 public:
  virtual ~LogWriter() = default;
  virtual void add(const mrpt::obs::CObservation::Ptr& observation) = 0;
  /// After the last.
  virtual void finish() {}
};

/// In frames, the odometry between two readings is the action, and what arrived between them the frame after it.
/// Readings that move nothing and see nothing are left out.
std::unique_ptr<LogWriter> makeLogWriter(SimulationOptions::Format format, source::RawlogWriter& rawlog);

}  // namespace omnimapper::sim
