#include <omnimapper/base/AtLoad.h>

#include "GeoJsonOutput.h"
#include "SurfacesOutput.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(GeoJsonOutputFactory));
  registerClass(CLASS_ID(SurfacesOutputFactory));
});

}  // namespace omnimapper::plugins
