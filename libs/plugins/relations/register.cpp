#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "RelationsPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<RelationsPlugin, RelationsOptions>::registerClass(); });

}  // namespace omnimapper::plugins
