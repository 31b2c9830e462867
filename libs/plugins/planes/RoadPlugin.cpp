#include "RoadPlugin.h"

#include <omnimapper/perception/DepthScan.h>
#include <omnimapper/plugin/SharedSection.h>

IMPLEMENTS_MRPT_OBJECT(RoadPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using RoadSection =
    mapper::SharedSection<perception::RoadOptions, perception::OutlineOptions, perception::RoadPoseOptions>;

bool RoadPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return perception::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> RoadPlugin::extract(const mrpt::obs::CObservation& raw) const {
  return {extractor_.extract(*perception::depthScanOf(raw))};
}

std::vector<perception::DerivedName> RoadPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + perception::kRoadSuffix}};
}

const std::vector<base::OptionSpec>& RoadPluginFactory::options() const {
  return RoadSection::options();
}

std::unique_ptr<perception::Extractor> RoadPluginFactory::make(const base::ConfigSection& section,
                                                               const mapper::PluginContext&) const {
  return std::make_unique<RoadPlugin>(RoadSection::read<perception::RoadOptions>(section),
                                      RoadSection::read<perception::OutlineOptions>(section),
                                      RoadSection::read<perception::RoadPoseOptions>(section));
}

}  // namespace omnimapper::plugins
