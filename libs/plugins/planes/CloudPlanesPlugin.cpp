#include "CloudPlanesPlugin.h"

#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/plugin/SharedSection.h>

IMPLEMENTS_MRPT_OBJECT(CloudPlanesPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using CloudPlanesSection = mapper::SharedSection<perception::CloudPlaneOptions, perception::CloudSensorOptions>;

bool CloudPlanesPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return extractor_.wants(raw);
}

std::vector<mrpt::obs::CObservation::Ptr> CloudPlanesPlugin::extract(const mrpt::obs::CObservation& raw) const {
  return {extractor_.extract(raw)};
}

std::vector<perception::DerivedName> CloudPlanesPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + perception::kPlanesSuffix}};
}

const std::vector<base::OptionSpec>& CloudPlanesPluginFactory::options() const {
  return CloudPlanesSection::options();
}

std::unique_ptr<perception::Extractor> CloudPlanesPluginFactory::make(const base::ConfigSection& section,
                                                                      const mapper::PluginContext&) const {
  return std::make_unique<CloudPlanesPlugin>(CloudPlanesSection::read<perception::CloudPlaneOptions>(section),
                                             CloudPlanesSection::read<perception::CloudSensorOptions>(section));
}

}  // namespace omnimapper::plugins
