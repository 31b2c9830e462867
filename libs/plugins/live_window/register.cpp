#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "LiveWindow.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<LiveWindow, LiveWindowOptions>::registerClass(); });

}  // namespace omnimapper::plugins
