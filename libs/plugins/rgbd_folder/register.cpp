#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>

#include "RgbdFolder.h"

namespace omnimapper::source {

const base::AtLoad kRegister([] { SourceOf<RgbdFolder, RgbdFolderOptions>::registerClass(); });

}  // namespace omnimapper::source
