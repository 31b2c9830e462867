#include <omnimapper/base/AtLoad.h>
#include <omnimapper/drivers/CCheckedHokuyo.h>
#include <omnimapper/drivers/CCommandFile.h>
#include <omnimapper/drivers/COdometryLines.h>

namespace omnimapper::drivers {

namespace {

const base::AtLoad kRegister([] {
  CCheckedHokuyo::doRegister();
  CCommandFile::doRegister();
  COdometryLines::doRegister();
});

}  // namespace

}  // namespace omnimapper::drivers
