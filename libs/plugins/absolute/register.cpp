#include <omnimapper/base/AtLoad.h>

#include "GivenMotionPlugin.h"
#include "GpsPlugin.h"
#include "RobotPosePlugin.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(GivenMotionPluginFactory));
  registerClass(CLASS_ID(GpsPluginFactory));
  registerClass(CLASS_ID(RobotPosePluginFactory));
});

}  // namespace omnimapper::plugins
