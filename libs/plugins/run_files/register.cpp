#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "GraphOutput.h"
#include "LocalizationOutput.h"
#include "SummaryOutput.h"
#include "TrajectoryOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<GraphOutput, GraphOutputOptions>::registerClass();
  mapper::FactoryOf<LocalizationOutput, LocalizationOptions>::registerClass();
  mapper::FactoryOf<SummaryOutput, SummaryOptions>::registerClass();
  mapper::FactoryOf<TrajectoryOutput, TrajectoryOptions>::registerClass();
});

}  // namespace omnimapper::plugins
