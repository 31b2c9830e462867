#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "PointLandmarksPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<PointLandmarksPlugin, PointLandmarksOptions>::registerClass(); });

}  // namespace omnimapper::plugins
