#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/ExtractorFactoryOf.h>
#include <omnimapper/signs/DoorSignExtractor.h>

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  mapper::registerFactoryBases();
  mapper::ExtractorFactoryOf<signs::DoorSignExtractor, signs::DoorSignOptions>::registerClass();
});

}  // namespace omnimapper::plugins
