#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/SourceOptions.h>

namespace omnimapper::source {

/// Selects observations by sensor label and time.
class ObservationFilter {
 public:
  explicit ObservationFilter(const SourceOptions& options);

  /// Sets the time from which start_s and end_s are counted, unless that is 1970.
  void setLogStart(base::Stamp log_start);
  bool knowsLogStart() const { return !is_relative_ || base::isValid(log_start_); }

  /// Whether the observation is selected. One without a stamp is selected only if no time is set; a motion only if its
  /// whole span is within the times.
  bool wants(const mrpt::obs::CObservation& observation) const;
  bool isAfterTheEnd(const mrpt::obs::CObservation& observation) const;

 private:
  SourceOptions options_;
  bool is_relative_;
  base::Stamp log_start_;
  base::Stamp begin_;  // "no stamp": open
  base::Stamp end_;
};

}  // namespace omnimapper::source
