#include <omnimapper/base/AtLoad.h>
#include <omnimapper/perception/CloudPlaneExtractor.h>
#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "PlaneLandmarksPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<PlaneLandmarksPlugin, PlaneLandmarksOptions>::registerClass();
  mapper::FactoryOf<perception::PlaneExtractor, perception::PlaneOptions, perception::OutlineOptions,
                    perception::PlaneComparisonOptions>::registerClass();
  mapper::FactoryOf<perception::CloudPlaneExtractor, perception::CloudPlaneOptions,
                    perception::CloudSensorOptions>::registerClass();
  mapper::FactoryOf<perception::LaserLineExtractor, perception::LaserLineOptions>::registerClass();
  mapper::FactoryOf<perception::RoadExtractor, perception::RoadOptions, perception::OutlineOptions,
                    perception::RoadPoseOptions>::registerClass();
});

}  // namespace omnimapper::plugins
