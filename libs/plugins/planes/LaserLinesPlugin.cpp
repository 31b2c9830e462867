#include "LaserLinesPlugin.h"

IMPLEMENTS_MRPT_OBJECT(LaserLinesPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

bool LaserLinesPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> LaserLinesPlugin::extract(const mrpt::obs::CObservation& raw) const {
  return {extractor_.extract(dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(raw))};
}

std::vector<perception::DerivedName> LaserLinesPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationLaserLines), raw.sensorLabel + perception::kLinesSuffix}};
}

const std::vector<base::OptionSpec>& LaserLinesPluginFactory::options() const {
  return perception::LaserLineOptions::table().specs();
}

std::unique_ptr<perception::Extractor> LaserLinesPluginFactory::make(const base::ConfigSection& section,
                                                                     const mapper::PluginContext&) const {
  return std::make_unique<LaserLinesPlugin>(section.read<perception::LaserLineOptions>(mapper::sectionKeysOfEngine()));
}

}  // namespace omnimapper::plugins
