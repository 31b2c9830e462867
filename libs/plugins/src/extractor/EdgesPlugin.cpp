#include <omnimapper/plugins/EdgesPlugin.h>

IMPLEMENTS_MRPT_OBJECT(EdgesPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using mrpt::obs::CObservation3DRangeScan;

bool EdgesPlugin::wants(const mrpt::obs::CObservation& raw) const {
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&raw);
  return scan != nullptr && scan->hasRangeImage;
}

std::vector<mrpt::obs::CObservation::Ptr> EdgesPlugin::extract(const mrpt::obs::CObservation& raw) const {
  const auto clouds = extractor_.extract(dynamic_cast<const CObservation3DRangeScan&>(raw));
  return {clouds.begin(), clouds.end()};
}

const std::vector<base::OptionSpec>& EdgesPluginFactory::options() const {
  return perception::EdgeOptions::table().specs();
}

std::unique_ptr<mapper::Extractor> EdgesPluginFactory::make(const base::ConfigSection& section,
                                                            const mapper::PluginContext&) const {
  return std::make_unique<EdgesPlugin>(section.read<perception::EdgeOptions>(mapper::sectionKeysOfEngine()));
}

}  // namespace omnimapper::plugins
