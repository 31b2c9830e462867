#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/ImageFolder.h>
#include <omnimapper/source/PcdFolder.h>
#include <omnimapper/source/RgbdFolder.h>
#include <omnimapper/source/SourceFactory.h>

namespace omnimapper::source {

namespace {

const base::AtLoad kRegister([] {
  SourceOf<CarmenLog, CarmenOptions>::registerClass();
  SourceOf<ImageFolder, ImageFolderOptions>::registerClass();
  SourceOf<PcdFolder, PcdFolderOptions>::registerClass();
  SourceOf<RgbdFolder, RgbdFolderOptions>::registerClass();
});

}  // namespace

}  // namespace omnimapper::source
