#include "run/MissingExtractors.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <algorithm>
#include <exception>

namespace omnimapper::mapper {

namespace {

bool derives(const perception::Extractor& extractor, const mrpt::obs::CObservation& observation,
             const MeasurementPlugin& plugin) {
  if (!extractor.wants(observation)) return false;
  const auto made = extractor.extract(observation);
  return std::any_of(made.begin(), made.end(), [&](const auto& derived) { return plugin.wants(*derived); });
}

// Tries the extractor with its default options; one that needs other options, or throws, gives nothing.
bool givesSomething(const ExtractorFactory& factory, const mrpt::obs::CObservation& observation,
                    const MeasurementPlugin& plugin) {
  try {
    const auto config = base::Config::fromText("[extractor]\nclass = " + factory.name() + "\n", "defaults");
    PluginContext context;
    context.section = "extractor";
    return derives(*factory.make(config.section("extractor"), context), observation, plugin);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

void SensorSamples::add(const mrpt::obs::CObservation::ConstPtr& observation) {
  constexpr std::size_t kMost = 32;  // a damaged log may give every observation its own label
  if (samples_.size() < kMost)
    samples_.try_emplace({observation->sensorLabel, observation->GetRuntimeClass()}, observation);
}

bool SensorSamples::isFedBy(const std::vector<Named<perception::Extractor>>& extractors,
                            const MeasurementPlugin& plugin) const {
  const auto feeds = [&](const perception::Extractor& extractor) {
    return std::any_of(samples_.begin(), samples_.end(), [&](const auto& sample) {
      try {
        return derives(extractor, *sample.second, plugin);
      } catch (const std::exception&) {
        return false;
      }
    });
  };
  return std::any_of(extractors.begin(), extractors.end(),
                     [&](const auto& extractor) { return feeds(*extractor.plugin); });
}

std::string SensorSamples::extractorsFor(const MeasurementPlugin& plugin) const {
  std::string names;
  for (const auto& factory : registeredFactories()) {
    const auto* extractors = dynamic_cast<const ExtractorFactory*>(factory.get());
    if (!extractors) continue;
    const bool helps = std::any_of(samples_.begin(), samples_.end(), [&](const auto& sample) {
      return givesSomething(*extractors, *sample.second, plugin);
    });
    if (helps) names += (names.empty() ? "" : " or ") + extractors->name();
  }
  return names.empty() ? ""
                       : names +
                             " would derive suitable observations from the log: add a section with that class, and "
                             "name it in [perception] extractors";
}

}  // namespace omnimapper::mapper
