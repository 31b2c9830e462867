#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>

#include "ImageFolder.h"

namespace omnimapper::source {

const base::AtLoad kRegister([] { SourceOf<ImageFolder, ImageFolderOptions>::registerClass(); });

}  // namespace omnimapper::source
