#include "run/PerceptionLine.h"

#include <utility>

namespace omnimapper::mapper {

using mrpt::obs::CObservation;

PerceptionLine::PerceptionLine(const Extractors& extractors, int threads)
    : extractors_(extractors), last_(extractors.size()), depth_(4 * static_cast<std::size_t>(threads)), pool_(threads) {
  for (const auto& [section, extractor] : extractors_) novelties_.push_back(extractor->novelty());
}

Outcome PerceptionLine::outcomeOf(const perception::Extractor& extractor, const CObservation& raw,
                                  perception::Blackboard& board) {
  Outcome outcome;
  outcome.wanted = true;
  try {
    outcome.derived = extractor.extractUsing(raw, board);
  } catch (const base::Error& error) {
    outcome.error = error;
  }
  return outcome;
}

Outcome PerceptionLine::repeated(const Outcome& earlier, const CObservation& raw) {
  Outcome outcome;
  outcome.wanted = true;
  outcome.unchanged = true;
  outcome.error = earlier.error;
  for (const auto& derived : earlier.derived) {
    auto copy = std::dynamic_pointer_cast<CObservation>(derived->duplicateGetSmartPtr());
    copy->timestamp = raw.timestamp;
    outcome.derived.push_back(std::move(copy));
  }
  return outcome;
}

void PerceptionLine::add(const CObservation::Ptr& raw) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < extractors_.size(); ++i) {
    const auto task = [&] {
      if (!extractors_[i].plugin->wants(*raw)) return Task::none;
      return novelties_[i] == nullptr || novelties_[i]->isNew(*raw) ? Task::extract : Task::repeat;
    };
    tasks.push_back(task());
  }
  auto outcomes = pool_.submit<std::vector<Outcome>>([this, raw, tasks] {
    std::vector<Outcome> all;
    perception::Blackboard board;
    for (std::size_t i = 0; i < tasks.size(); ++i)
      all.push_back(tasks[i] == Task::extract ? outcomeOf(*extractors_[i].plugin, *raw, board) : Outcome());
    return all;
  });
  items_.push_back({raw, std::move(tasks), std::move(outcomes)});
}

PerceptionLine::Perceived PerceptionLine::take() {
  Item item = std::move(items_.front());
  items_.pop_front();
  Perceived perceived{item.raw, item.outcomes.get()};
  for (std::size_t i = 0; i < item.tasks.size(); ++i) {
    if (novelties_[i] == nullptr || item.tasks[i] == Task::none) continue;
    Outcome& last = last_[i][item.raw->sensorLabel];
    if (item.tasks[i] == Task::extract) last = perceived.outcomes[i];
    if (item.tasks[i] == Task::repeat) perceived.outcomes[i] = repeated(last, *item.raw);
  }
  return perceived;
}

}  // namespace omnimapper::mapper
