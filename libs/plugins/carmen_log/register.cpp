#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>

#include "CarmenLog.h"

namespace omnimapper::source {

const base::AtLoad kRegister([] { SourceOf<CarmenLog, CarmenOptions>::registerClass(); });

}  // namespace omnimapper::source
