#include "EdgesPlugin.h"

#include <omnimapper/perception/DepthScan.h>

IMPLEMENTS_MRPT_OBJECT(EdgesPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

bool EdgesPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return perception::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> EdgesPlugin::extract(const mrpt::obs::CObservation& raw) const {
  const auto clouds = extractor_.extract(*perception::depthScanOf(raw));
  return {clouds.begin(), clouds.end()};
}

std::vector<perception::DerivedName> EdgesPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  std::vector<perception::DerivedName> names;
  for (auto& label : extractor_.labelsOf(*perception::depthScanOf(raw)))
    names.push_back({CLASS_ID(mrpt::obs::CObservationPointCloud), std::move(label)});
  return names;
}

const std::vector<base::OptionSpec>& EdgesPluginFactory::options() const {
  return perception::EdgeOptions::table().specs();
}

std::unique_ptr<perception::Extractor> EdgesPluginFactory::make(const base::ConfigSection& section,
                                                                const mapper::PluginContext&) const {
  return std::make_unique<EdgesPlugin>(section.read<perception::EdgeOptions>(mapper::sectionKeysOfEngine()));
}

}  // namespace omnimapper::plugins
