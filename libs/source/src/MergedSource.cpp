#include <omnimapper/source/MergedSource.h>

#include <algorithm>
#include <optional>

namespace omnimapper::source {

namespace {

struct TimeSpan {
  base::Stamp begin, end;
};

std::optional<TimeSpan> spanOf(const SourceReport& report) {
  std::optional<TimeSpan> span;
  for (const auto& [sensor, counts] : report.sensors) {
    if (!base::isValid(counts.first_stamp)) continue;
    if (!span) span = {counts.first_stamp, counts.last_stamp};
    span->begin = std::min(span->begin, counts.first_stamp);
    span->end = std::max(span->end, counts.last_stamp);
  }
  return span;
}

// Whether one log lies so far from all others in time that it is not part of the same drive.
bool isOneFarFromOthers(const std::vector<TimeSpan>& spans) {
  constexpr double kNextPart = 60;  // [s] longest pause between two parts of a log that was split
  const auto areNear = [](const TimeSpan& a, const TimeSpan& b) {
    return base::secondsBetween(a.end, b.begin) < kNextPart && base::secondsBetween(b.end, a.begin) < kNextPart;
  };
  return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan& one) {
    return std::none_of(spans.begin(), spans.end(),
                        [&](const TimeSpan& other) { return &other != &one && areNear(one, other); });
  });
}

}  // namespace

MergedSource::MergedSource(std::vector<std::unique_ptr<ObservationSource>> sources) {
  for (auto& source : sources) inputs_.push_back({std::move(source), nullptr, base::Stamp()});
}

void MergedSource::advance(Input& input) {
  input.head = input.source->next();
  if (input.head) input.latest = std::max(input.latest, input.head->timestamp);
}

mrpt::obs::CObservation::Ptr MergedSource::next() {
  if (!is_started_) {
    for (auto& input : inputs_) advance(input);
    is_started_ = true;
  }
  Input* earliest = nullptr;
  for (auto& input : inputs_)
    if (input.head && (!earliest || input.latest < earliest->latest)) earliest = &input;
  if (!earliest) return nullptr;
  const auto observation = earliest->head;
  advance(*earliest);
  return observation;
}

double MergedSource::progress() const {
  double sum = 0;
  for (const auto& input : inputs_) sum += input.source->progress();
  return inputs_.empty() ? 1.0 : sum / static_cast<double>(inputs_.size());
}

SourceReport MergedSource::report() const {
  SourceReport sum;
  sum.ending = SourceReport::Ending::complete;
  std::vector<TimeSpan> spans;
  for (const auto& input : inputs_) {
    const auto report = input.source->report();
    sum.add(report);
    if (const auto span = spanOf(report)) spans.push_back(*span);
  }
  sum.has_logs_apart = sum.ending != SourceReport::Ending::open && spans.size() > 1 && isOneFarFromOthers(spans);
  return sum;
}

void MergedSource::interrupt() {
  for (auto& input : inputs_) input.source->interrupt();
}

}  // namespace omnimapper::source
