#include <omnimapper/base/AtLoad.h>
#include <omnimapper/live/COdometryLines.h>

namespace omnimapper::live {

namespace {

const base::AtLoad kRegister([] { COdometryLines::doRegister(); });

}  // namespace

}  // namespace omnimapper::live
