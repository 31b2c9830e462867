#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>

#include "RosLog.h"

namespace omnimapper::ros {

const base::AtLoad kRegister([] { source::SourceOf<RosLog, RosLogOptions>::registerClass(); });

}  // namespace omnimapper::ros
