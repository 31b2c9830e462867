#include "PlanesPlugin.h"

#include <omnimapper/perception/DepthScan.h>
#include <omnimapper/plugin/SharedSection.h>

IMPLEMENTS_MRPT_OBJECT(PlanesPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using PlanesSection =
    mapper::SharedSection<perception::PlaneComparisonOptions, perception::PlaneOptions, perception::OutlineOptions>;

bool PlanesPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return perception::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> PlanesPlugin::extract(const mrpt::obs::CObservation& raw) const {
  return {extractor_.extract(*perception::depthScanOf(raw))};
}

std::vector<perception::DerivedName> PlanesPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + perception::kPlanesSuffix}};
}

const std::vector<base::OptionSpec>& PlanesPluginFactory::options() const {
  return PlanesSection::options();
}

std::unique_ptr<perception::Extractor> PlanesPluginFactory::make(const base::ConfigSection& section,
                                                                 const mapper::PluginContext&) const {
  return std::make_unique<PlanesPlugin>(PlanesSection::read<perception::PlaneOptions>(section),
                                        PlanesSection::read<perception::OutlineOptions>(section),
                                        PlanesSection::read<perception::PlaneComparisonOptions>(section));
}

}  // namespace omnimapper::plugins
