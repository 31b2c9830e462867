#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "PointsOutput.h"
#include "SceneOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<PointsOutput, derived::PointsOptions>::registerClass();
  mapper::FactoryOf<SceneOutput, SceneOptions>::registerClass();
});

}  // namespace omnimapper::plugins
