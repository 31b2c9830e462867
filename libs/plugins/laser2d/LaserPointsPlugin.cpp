#include "LaserPointsPlugin.h"

#include <mrpt/obs/CObservationPointCloud.h>

IMPLEMENTS_MRPT_OBJECT(LaserPointsPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

bool LaserPointsPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> LaserPointsPlugin::extract(const mrpt::obs::CObservation& raw) const {
  return {extractor_.extract(dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(raw))};
}

std::vector<perception::DerivedName> LaserPointsPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(mrpt::obs::CObservationPointCloud), raw.sensorLabel + perception::kPointsSuffix}};
}

const std::vector<base::OptionSpec>& LaserPointsPluginFactory::options() const {
  return perception::LaserPointsOptions::table().specs();
}

std::unique_ptr<perception::Extractor> LaserPointsPluginFactory::make(const base::ConfigSection& section,
                                                                      const mapper::PluginContext&) const {
  return std::make_unique<LaserPointsPlugin>(
      section.read<perception::LaserPointsOptions>(mapper::sectionKeysOfEngine()));
}

}  // namespace omnimapper::plugins
