#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "LevelPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<LevelPlugin, LevelOptions>::registerClass(); });

}  // namespace omnimapper::plugins
