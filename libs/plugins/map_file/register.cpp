#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "MapOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<MapOutput, MapOutputOptions>::registerClass(); });

}  // namespace omnimapper::plugins
