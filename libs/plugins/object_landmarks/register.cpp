#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "ObjectLandmarksPlugin.h"
#include "ObjectsOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<ObjectLandmarksPlugin, ObjectLandmarksOptions>::registerClass();
  mapper::FactoryOf<ObjectsOutput, ObjectsOptions>::registerClass();
});

}  // namespace omnimapper::plugins
