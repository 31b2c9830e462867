#include <omnimapper/base/AtLoad.h>

#include "NoMotionPlugin.h"
#include "OdometryPlugin.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(NoMotionPluginFactory));
  registerClass(CLASS_ID(OdometryPluginFactory));
});

}  // namespace omnimapper::plugins
