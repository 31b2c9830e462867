#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>
#include <omnimapper/signs/DoorSignExtractor.h>

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<signs::DoorSignExtractor, signs::DoorSignOptions>::registerClass();
});

}  // namespace omnimapper::plugins
