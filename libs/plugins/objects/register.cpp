#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/plugin/ExtractorFactoryOf.h>

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  mapper::registerFactoryBases();
  mapper::ExtractorFactoryOf<perception::ObjectExtractor, perception::PlaneOptions, perception::OutlineOptions,
                             perception::ObjectOptions, perception::ObjectPointOptions,
                             perception::PlaneReuseOptions>::registerClass();
  mapper::ExtractorFactoryOf<perception::EdgeExtractor, perception::EdgeOptions>::registerClass();
});

}  // namespace omnimapper::plugins
