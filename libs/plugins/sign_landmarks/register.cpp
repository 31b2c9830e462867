#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "SignLandmarksPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<SignLandmarksPlugin, SignLandmarksOptions>::registerClass(); });

}  // namespace omnimapper::plugins
