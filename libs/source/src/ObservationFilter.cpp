#include "ObservationFilter.h"

#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <algorithm>

namespace omnimapper::source {

ObservationFilter::ObservationFilter(const SourceOptions& options)
    : options_(options), is_relative_(options.time_reference == TimeReference::log_start) {
  if (!is_relative_) setLogStart(base::stampFromUnix(0));
}

void ObservationFilter::setLogStart(base::Stamp log_start) {
  log_start_ = log_start;
  if (options_.start > 0) begin_ = log_start + base::durationFromSeconds(options_.start);
  if (options_.end > 0) end_ = log_start + base::durationFromSeconds(options_.end);
}

bool ObservationFilter::wants(const mrpt::obs::CObservation& observation) const {
  const auto& labels = options_.labels;
  if (!labels.empty() && std::find(labels.begin(), labels.end(), observation.sensorLabel) == labels.end()) return false;
  if (options_.start <= 0 && options_.end <= 0) return true;
  if (!base::isValid(observation.timestamp)) return false;
  const auto* motion = dynamic_cast<const obs::CObservationRelativeMotion*>(&observation);
  const base::Stamp first = motion ? motion->begin : observation.timestamp;
  return (options_.start <= 0 || first >= begin_) && (options_.end <= 0 || observation.timestamp <= end_);
}

bool ObservationFilter::isAfterTheEnd(const mrpt::obs::CObservation& observation) const {
  return options_.end > 0 && knowsLogStart() && observation.timestamp > end_;
}

}  // namespace omnimapper::source
