#include <omnimapper/base/AtLoad.h>

#include "BeaconFactor.h"
#include "BeaconPayload.h"
#include "BeaconPlugin.h"
#include "BeaconVariable.h"

namespace mapper = omnimapper::mapper;

IMPLEMENTS_MRPT_OBJECT(BeaconPluginFactory, omnimapper::mapper::MeasurementPluginFactory, beacons)

namespace beacons {

// Without this a map with beacons could be written, but not read again.
void BeaconPluginFactory::registerKinds(mapper::Kinds& kinds) const {
  kinds.factors.add(beaconVariable());
  BeaconFactor::addTo(kinds.factors);
  BeaconPayload::addTo(kinds.payloads);
}

std::unique_ptr<mapper::MeasurementPlugin> BeaconPluginFactory::make(const omnimapper::base::ConfigSection& section,
                                                                     const mapper::PluginContext& context) const {
  return std::make_unique<BeaconPlugin>(section.read<BeaconOptions>(mapper::sectionKeysOfEngine()), context);
}

const omnimapper::base::AtLoad kRegister([] { mrpt::rtti::registerClass(CLASS_ID(BeaconPluginFactory)); });

}  // namespace beacons
