#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "BeaconFactor.h"
#include "BeaconPayload.h"
#include "BeaconPlugin.h"
#include "BeaconVariable.h"

namespace mapper = omnimapper::mapper;

namespace beacons {

// Step 7: the factory, by which an INI can name the plugin: "class = BeaconPlugin".

// Without this a map with beacons could be written, but not read again.
void BeaconPlugin::registerKinds(mapper::Kinds& kinds) {
  kinds.factors.add(beaconVariable());
  BeaconFactor::addTo(kinds.factors);
  BeaconPayload::addTo(kinds.payloads);
}

const omnimapper::base::AtLoad kRegister([] { mapper::FactoryOf<BeaconPlugin, BeaconOptions>::registerClass(); });

}  // namespace beacons
