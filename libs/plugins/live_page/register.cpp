#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "LivePage.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] { mapper::FactoryOf<LivePage, LivePageOptions>::registerClass(); });

}  // namespace omnimapper::plugins
