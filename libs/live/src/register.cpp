#include <omnimapper/base/AtLoad.h>
#include <omnimapper/live/CCheckedHokuyo.h>
#include <omnimapper/live/COdometryLines.h>

namespace omnimapper::live {

namespace {

const base::AtLoad kRegister([] {
  CCheckedHokuyo::doRegister();
  COdometryLines::doRegister();
});

}  // namespace

}  // namespace omnimapper::live
