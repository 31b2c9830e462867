#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/SourceOptions.h>

namespace omnimapper::source {

/// Which observations are wanted: by sensor label and by time.
class ObservationFilter {
 public:
  explicit ObservationFilter(const SourceOptions& options);

  /// What start_s and end_s count from, unless that is 1970.
  void setLogStart(base::Stamp log_start);
  bool knowsLogStart() const { return !is_relative_ || base::isValid(log_start_); }

  /// Without a stamp it is wanted only where no time is set. A motion is wanted if its whole span is.
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
