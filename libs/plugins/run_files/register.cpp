#include <omnimapper/base/AtLoad.h>

#include "GraphOutput.h"
#include "LocalizationOutput.h"
#include "SummaryOutput.h"
#include "TrajectoryOutput.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(GraphOutputFactory));
  registerClass(CLASS_ID(LocalizationOutputFactory));
  registerClass(CLASS_ID(SummaryOutputFactory));
  registerClass(CLASS_ID(TrajectoryOutputFactory));
});

}  // namespace omnimapper::plugins
