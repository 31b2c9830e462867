#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "LoopClosurePlugin.h"
#include "ScanOdometryPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<LoopClosurePlugin, LoopClosureOptions, matching::ScanMatcherOptions>::registerClass();
  mapper::FactoryOf<ScanOdometryPlugin, ScanOdometryOptions, matching::ScanTrackerOptions, matching::ScanMatcherOptions,
                    perception::LaserPointsOptions>::registerClass();
  mapper::FactoryOf<perception::LaserPointsExtractor, perception::LaserPointsOptions>::registerClass();
});

}  // namespace omnimapper::plugins
