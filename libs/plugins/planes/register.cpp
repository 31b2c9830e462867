#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/CloudPlaneExtractor.h>
#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/plugin/ExtractorFactoryOf.h>

#include "PlaneLandmarksPlugin.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(PlaneLandmarksPluginFactory));
  mapper::ExtractorFactoryOf<perception::PlaneExtractor, perception::PlaneOptions, perception::OutlineOptions,
                             perception::PlaneComparisonOptions>::registerClass();
  mapper::ExtractorFactoryOf<perception::CloudPlaneExtractor, perception::CloudPlaneOptions,
                             perception::CloudSensorOptions>::registerClass();
  mapper::ExtractorFactoryOf<perception::LaserLineExtractor, perception::LaserLineOptions>::registerClass();
  mapper::ExtractorFactoryOf<perception::RoadExtractor, perception::RoadOptions, perception::OutlineOptions,
                             perception::RoadPoseOptions>::registerClass();
});

}  // namespace omnimapper::plugins
