#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>

#include "CommandLog.h"

namespace omnimapper::source {

const base::AtLoad kRegister([] { SourceOf<CommandLog, CommandLogOptions>::registerClass(); });

}  // namespace omnimapper::source
