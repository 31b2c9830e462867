#include "ObjectsPlugin.h"

#include <omnimapper/perception/DepthScan.h>
#include <omnimapper/plugin/SharedSection.h>

IMPLEMENTS_MRPT_OBJECT(ObjectsPluginFactory, omnimapper::mapper::ExtractorFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using namespace perception;
using ObjectsSection = mapper::SharedSection<PlaneOptions, OutlineOptions, ObjectOptions, ObjectPointOptions>;

bool ObjectsPlugin::wants(const mrpt::obs::CObservation& raw) const {
  return perception::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> ObjectsPlugin::extract(const mrpt::obs::CObservation& raw) const {
  const auto found = extractor_.extract(*perception::depthScanOf(raw));
  ++scans_;
  with_surface_ += found.has_surface;
  return {found.planes, found.objects};
}

std::vector<std::string> ObjectsPlugin::warnings() const {
  if (scans_ == 0 || with_surface_ > 0 || !on_surfaces_only_) return {};
  return {"none of " + std::to_string(scans_) +
          " scans shows a level surface for things to stand on: is the sensor's place on the base right, which tells "
          "what is level? For a camera in the hand set max_tilt_deg = 75"};
}

std::vector<perception::DerivedName> ObjectsPlugin::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kPlanesSuffix},
          {CLASS_ID(obs::CObservationObjects), raw.sensorLabel + kObjectsSuffix}};
}

const std::vector<base::OptionSpec>& ObjectsPluginFactory::options() const {
  return ObjectsSection::options();
}

std::unique_ptr<perception::Extractor> ObjectsPluginFactory::make(const base::ConfigSection& section,
                                                                  const mapper::PluginContext&) const {
  return std::make_unique<ObjectsPlugin>(ObjectExtractor::Options{
      ObjectsSection::read<PlaneOptions>(section), ObjectsSection::read<OutlineOptions>(section),
      ObjectsSection::read<ObjectOptions>(section), ObjectsSection::read<ObjectPointOptions>(section)});
}

}  // namespace omnimapper::plugins
