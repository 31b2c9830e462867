#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::mapper {

void loadFeatures() {
  obs::registerClasses();
  registerFactoryBases();
  base::loadFeaturesOf(base::Registered::plugin);
}

}  // namespace omnimapper::mapper
