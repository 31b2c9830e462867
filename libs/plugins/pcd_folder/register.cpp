#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>

#include "PcdFolder.h"

namespace omnimapper::source {

const base::AtLoad kRegister([] { SourceOf<PcdFolder, PcdFolderOptions>::registerClass(); });

}  // namespace omnimapper::source
