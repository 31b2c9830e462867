#pragma once

#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/SourceOptions.h>
#include <omnimapper/source/SourceReport.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ObservationFilter.h"
#include "SensorClocks.h"

namespace omnimapper::source {

/// Which observations of a log are handed out, whatever its format: those of the sensors whose clocks have one offset,
/// of the wanted labels and times, whose external files are there, and that the gate lets pass. Counts them.
class ObservationSelection {
 public:
  /// Loads the external files of an observation; returns the first that cannot be read.
  using Load = std::function<std::optional<std::string>(const mrpt::obs::CObservation&)>;

  /// `clock_offset` [s]: of the sensors that options.clock_offsets names, those with this offset are handed out; with 0
  /// also all others.
  ObservationSelection(const SourceOptions& options, double clock_offset, Load load = {});

  /// Whether the observation is handed out. Converts its label by base::sensorName() and corrects its stamp.
  bool takes(mrpt::obs::CObservation& observation);
  /// Whether everything that is wanted has been read.
  bool isOver() const { return is_over_; }

  /// The stamp that a handed-out observation has.
  base::Stamp corrected(const mrpt::obs::CObservation& observation) const { return clocks_.corrected(observation); }
  void setLogStart(base::Stamp log_start) { filter_.setLogStart(log_start); }
  void setGate(std::shared_ptr<ObservationGate> gate) { gate_ = std::move(gate); }

  /// Adds what was counted to the report of the log's reader, which knows all observations. What concerns the log as a
  /// whole stays only in the report of the sensors without an offset.
  SourceReport report(SourceReport of_reader) const;

 private:
  SensorClocks clocks_;
  ObservationFilter filter_;
  Load load_;
  std::shared_ptr<ObservationGate> gate_ = std::make_shared<ObservationGate>();
  SourceReport counts_;
  int after_the_end_ = 0;  // number of observations in a row after the wanted time
  bool is_over_ = false;
};

}  // namespace omnimapper::source
