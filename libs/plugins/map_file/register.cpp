#include <omnimapper/base/AtLoad.h>

#include "MapOutput.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(MapOutputFactory));
});

}  // namespace omnimapper::plugins
