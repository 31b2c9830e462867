#include "ObservationSelection.h"

#include <omnimapper/base/Names.h>

#include <utility>

namespace omnimapper::source {

namespace {
// After so many observations in a row beyond the end of the wanted time, the rest of the log is not read.
constexpr int kEnoughAfterTheEnd = 1000;
}  // namespace

ObservationSelection::ObservationSelection(const SourceOptions& options, double clock_offset, Load load)
    : clocks_(options.clock_offsets, clock_offset), filter_(options), load_(std::move(load)) {}

bool ObservationSelection::takes(mrpt::obs::CObservation& observation) {
  observation.sensorLabel = base::sensorName(observation.sensorLabel);
  if (!clocks_.concerns(observation)) return false;
  clocks_.correct(observation);
  if (!filter_.knowsLogStart() && base::isValid(observation.timestamp)) filter_.setLogStart(observation.timestamp);
  after_the_end_ = filter_.isAfterTheEnd(observation) ? after_the_end_ + 1 : 0;
  if (after_the_end_ >= kEnoughAfterTheEnd) is_over_ = true;
  if (!filter_.wants(observation)) {
    ++counts_.filtered_out;
    counts_.filtered_labels.insert(observation.sensorLabel);
    return false;
  }
  if (const auto missing = load_ ? load_(observation) : std::nullopt) {
    if (counts_.missing_images++ == 0) counts_.first_missing_image = *missing;
    return false;
  }
  if (const auto reason = gate_->refuses(observation)) {
    counts_.countUnusable(observation.sensorLabel, *reason, observation.timestamp);
    return false;
  }
  counts_.count(observation.sensorLabel, observation.GetRuntimeClass()->className, observation.timestamp);
  return true;
}

SourceReport ObservationSelection::report(SourceReport of_reader) const {
  SourceReport report = counts_;
  report.ending = is_over_ ? SourceReport::Ending::complete : of_reader.ending;
  report.message = std::move(of_reader.message);
  report.unregistered_class = std::move(of_reader.unregistered_class);
  if (!clocks_.areFirst()) return report;  // another reader of the same log counts the rest
  report.objects = of_reader.objects;
  report.bytes = of_reader.bytes;
  report.other_objects = std::move(of_reader.other_objects);
  report.repaired_stamps = of_reader.repaired_stamps;
  report.dropped_actions = of_reader.dropped_actions;
  report.notes = std::move(of_reader.notes);
  report.doubts = std::move(of_reader.doubts);
  report.missing_images += of_reader.missing_images;
  if (report.first_missing_image.empty()) report.first_missing_image = std::move(of_reader.first_missing_image);
  return report;
}

}  // namespace omnimapper::source
