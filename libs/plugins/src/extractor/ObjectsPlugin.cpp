#include <omnimapper/plugins/ObjectsPlugin.h>

#include "../SharedSection.h"

IMPLEMENTS_MRPT_OBJECT(ObjectsPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using mrpt::obs::CObservation3DRangeScan;
using namespace perception;
using ObjectsSection = SharedSection<PlaneOptions, OutlineOptions, ObjectOptions, ObjectPointOptions>;

bool ObjectsPlugin::wants(const mrpt::obs::CObservation& raw) const {
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&raw);
  return scan != nullptr && scan->hasRangeImage;
}

std::vector<mrpt::obs::CObservation::Ptr> ObjectsPlugin::extract(const mrpt::obs::CObservation& raw) const {
  const auto found = extractor_.extract(dynamic_cast<const CObservation3DRangeScan&>(raw));
  return {found.planes, found.objects};
}

const std::vector<base::OptionSpec>& ObjectsPluginFactory::options() const {
  return ObjectsSection::options();
}

std::unique_ptr<mapper::Extractor> ObjectsPluginFactory::make(const base::ConfigSection& section,
                                                              const mapper::PluginContext&) const {
  return std::make_unique<ObjectsPlugin>(ObjectExtractor::Options{
      ObjectsSection::read<PlaneOptions>(section), ObjectsSection::read<OutlineOptions>(section),
      ObjectsSection::read<ObjectOptions>(section), ObjectsSection::read<ObjectPointOptions>(section)});
}

}  // namespace omnimapper::plugins
