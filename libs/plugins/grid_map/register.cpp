#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "GridOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<GridOutput, GridOptions>::registerClass(); });

}  // namespace omnimapper::plugins
