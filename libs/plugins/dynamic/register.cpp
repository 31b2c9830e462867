#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "DynamicLandmarksPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<DynamicLandmarksPlugin, DynamicLandmarksOptions>::registerClass();
});

}  // namespace omnimapper::plugins
