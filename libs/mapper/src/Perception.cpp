#include <omnimapper/mapper/Perception.h>

#include <algorithm>
#include <utility>

namespace omnimapper::mapper {

bool Perception::wants(const mrpt::obs::CObservation& raw) const {
  const auto takes = [&](const auto* part) { return part->wants(raw); };
  return std::any_of(extractors_.begin(), extractors_.end(), takes) ||
         std::any_of(plugins_.begin(), plugins_.end(), takes);
}

std::future<std::vector<Perceived>> Perception::submit(mrpt::obs::CObservation::ConstPtr raw) const {
  return pool_.submit<std::vector<Perceived>>([this, raw] {
    std::vector<Perceived> all;
    all.push_back(prepared(raw));
    for (const auto* extractor : extractors_) {
      if (!extractor->wants(*raw)) continue;
      for (auto& derived : extractor->extract(*raw)) all.push_back(prepared(derived));
    }
    return all;
  });
}

Perceived Perception::prepared(mrpt::obs::CObservation::ConstPtr observation) const {
  Perceived perceived{std::move(observation), {}};
  for (const auto* plugin : plugins_) {
    perceived.prepared.push_back(plugin->wants(*perceived.observation) ? plugin->prepare(*perceived.observation)
                                                                       : nullptr);
  }
  return perceived;
}

}  // namespace omnimapper::mapper
