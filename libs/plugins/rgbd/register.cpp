#include <omnimapper/base/AtLoad.h>

#include "CloudOdometryPlugin.h"
#include "ViewLinksPlugin.h"
#include "VisualOdometryPlugin.h"

namespace omnimapper::plugins {

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister([] {
  mapper::registerFactoryBases();
  mrpt::rtti::registerClass(CLASS_ID(VisualOdometryPluginFactory));
  mrpt::rtti::registerClass(CLASS_ID(CloudOdometryPluginFactory));
  mrpt::rtti::registerClass(CLASS_ID(ViewLinksPluginFactory));
});

}  // namespace omnimapper::plugins
