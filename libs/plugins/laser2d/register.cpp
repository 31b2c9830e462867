#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/plugin/ExtractorFactoryOf.h>

#include "LoopClosurePlugin.h"
#include "ScanOdometryPlugin.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(LoopClosurePluginFactory));
  registerClass(CLASS_ID(ScanOdometryPluginFactory));
  mapper::ExtractorFactoryOf<perception::LaserPointsExtractor, perception::LaserPointsOptions>::registerClass();
});

}  // namespace omnimapper::plugins
