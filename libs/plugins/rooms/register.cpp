#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "RoomFilesOutput.h"
#include "RoomsPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<RoomsPlugin, RoomsOptions>::registerClass();
  mapper::FactoryOf<RoomFilesOutput, RoomFilesOutputOptions>::registerClass();
});

}  // namespace omnimapper::plugins
