#include <omnimapper/source/MergedSource.h>

#include <algorithm>

namespace omnimapper::source {

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
  for (const auto& input : inputs_) sum.add(input.source->report());
  return sum;
}

void MergedSource::interrupt() {
  for (auto& input : inputs_) input.source->interrupt();
}

}  // namespace omnimapper::source
