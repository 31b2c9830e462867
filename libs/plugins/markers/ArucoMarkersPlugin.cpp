#include "ArucoMarkersPlugin.h"

IMPLEMENTS_MRPT_OBJECT(ArucoMarkersPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationImage;

// Null for any other observation, and for one without a picture.
const CObservation3DRangeScan* picturedScanOf(const mrpt::obs::CObservation& raw) {
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&raw);
  return scan != nullptr && scan->hasIntensityImage ? scan : nullptr;
}

}  // namespace

bool ArucoMarkersPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return dynamic_cast<const CObservationImage*>(&raw) != nullptr || picturedScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> ArucoMarkersPlugin::extract(const mrpt::obs::CObservation& raw) const {
  const auto* scan = picturedScanOf(raw);
  return {scan != nullptr ? extractor_.extract(*scan)
                          : extractor_.extract(dynamic_cast<const CObservationImage&>(raw))};
}

std::vector<perception::DerivedName> ArucoMarkersPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(mrpt::obs::CObservationBearingRange), raw.sensorLabel + perception::kMarkersSuffix}};
}

const std::vector<base::OptionSpec>& ArucoMarkersPluginFactory::options() const {
  return perception::ArucoMarkerOptions::table().specs();
}

std::unique_ptr<perception::Extractor> ArucoMarkersPluginFactory::make(const base::ConfigSection& section,
                                                                       const mapper::PluginContext&) const {
  return std::make_unique<ArucoMarkersPlugin>(
      section.read<perception::ArucoMarkerOptions>(mapper::sectionKeysOfEngine()));
}

}  // namespace omnimapper::plugins
