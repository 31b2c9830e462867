#include <omnimapper/base/AtLoad.h>

#include "PointsOutput.h"
#include "SceneOutput.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(PointsOutputFactory));
  registerClass(CLASS_ID(SceneOutputFactory));
});

}  // namespace omnimapper::plugins
