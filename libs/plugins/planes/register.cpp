#include <omnimapper/base/AtLoad.h>

#include "CloudPlanesPlugin.h"
#include "LaserLinesPlugin.h"
#include "PlaneLandmarksPlugin.h"
#include "PlanesPlugin.h"
#include "RoadPlugin.h"

namespace omnimapper::plugins {

// The build links this file last: the ids of the classes are made before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(CloudPlanesPluginFactory));
  registerClass(CLASS_ID(LaserLinesPluginFactory));
  registerClass(CLASS_ID(PlaneLandmarksPluginFactory));
  registerClass(CLASS_ID(PlanesPluginFactory));
  registerClass(CLASS_ID(RoadPluginFactory));
});

}  // namespace omnimapper::plugins
