#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "RoomsOutput.h"
#include "RoomsPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<RoomsPlugin, RoomsOptions>::registerClass();
  mapper::FactoryOf<RoomsOutput, RoomsOutputOptions>::registerClass();
});

}  // namespace omnimapper::plugins
