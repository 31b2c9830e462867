#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/ArucoMarkerExtractor.h>
#include <omnimapper/plugin/ExtractorFactoryOf.h>

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  mapper::registerFactoryBases();
  mapper::ExtractorFactoryOf<perception::ArucoMarkerExtractor, perception::ArucoMarkerOptions>::registerClass();
});

}  // namespace omnimapper::plugins
