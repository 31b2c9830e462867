#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "GivenMotionPlugin.h"
#include "GpsPlugin.h"
#include "RobotPosePlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<GivenMotionPlugin, GivenMotionOptions>::registerClass();
  mapper::FactoryOf<GpsPlugin, GpsOptions>::registerClass();
  mapper::FactoryOf<RobotPosePlugin, RobotPoseOptions>::registerClass();
});

}  // namespace omnimapper::plugins
