#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "ReportOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<ReportOutput, ReportOptions>::registerClass(); });

}  // namespace omnimapper::plugins
