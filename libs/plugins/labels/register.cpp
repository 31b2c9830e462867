#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "LabelsPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<LabelsPlugin, LabelsOptions, interaction::SkeletonFormat, interaction::GestureOptions,
                    interaction::TargetOptions>::registerClass();
});

}  // namespace omnimapper::plugins
