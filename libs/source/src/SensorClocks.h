#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::source {

/// The sensors of a log whose stamps are corrected by one and the same offset.
class SensorClocks {
 public:
  /// All sensors, without a correction.
  SensorClocks() = default;
  /// The sensors of `clock_offsets`, by label, with the offset [s]; offset 0 also stands for all sensors that are not
  /// named there.
  SensorClocks(std::map<std::string, double> clock_offsets, double offset)
      : clock_offsets_(std::move(clock_offsets)), offset_(offset) {}

  /// The different offsets, 0 first: each needs a reader of the log of its own.
  static std::vector<double> offsetsIn(const std::map<std::string, double>& clock_offsets);
  bool concerns(const mrpt::obs::CObservation& observation) const;
  /// Whether these are the sensors for which everything else in the log is counted, too.
  bool areFirst() const { return offset_ == 0; }
  /// The corrected stamp of an observation of any sensor.
  base::Stamp corrected(const mrpt::obs::CObservation& observation) const;
  /// Corrects the stamps of an observation that has some.
  void correct(mrpt::obs::CObservation& observation) const;

 private:
  double offsetOf(const mrpt::obs::CObservation& observation) const;

  std::map<std::string, double> clock_offsets_;
  double offset_ = 0;  // [s]
};

}  // namespace omnimapper::source
