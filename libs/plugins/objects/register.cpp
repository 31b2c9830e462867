#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/plugin/FactoryOf.h>

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<perception::ObjectExtractor, perception::PlaneOptions, perception::OutlineOptions,
                    perception::ObjectOptions, perception::ObjectPointOptions,
                    perception::PlaneReuseOptions>::registerClass();
  mapper::FactoryOf<perception::EdgeExtractor, perception::EdgeOptions>::registerClass();
});

}  // namespace omnimapper::plugins
