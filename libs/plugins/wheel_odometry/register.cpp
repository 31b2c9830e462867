#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "NoMotionPlugin.h"
#include "OdometryPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<NoMotionPlugin, NoMotionOptions>::registerClass();
  mapper::FactoryOf<OdometryPlugin, OdometryOptions>::registerClass();
});

}  // namespace omnimapper::plugins
