#include <omnimapper/base/AtLoad.h>

#include "EdgesPlugin.h"
#include "ObjectsPlugin.h"

namespace omnimapper::plugins {

// The build links this file last: the ids of the classes are made before.
const base::AtLoad kRegister([] {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(EdgesPluginFactory));
  registerClass(CLASS_ID(ObjectsPluginFactory));
});

}  // namespace omnimapper::plugins
