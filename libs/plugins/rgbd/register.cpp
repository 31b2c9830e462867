#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "CloudOdometryPlugin.h"
#include "ViewLinksPlugin.h"
#include "VisualOdometryPlugin.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<VisualOdometryPlugin, CameraOdometryOptions, matching::RgbdTrackerOptions,
                    matching::DenseMatcherOptions, matching::FeatureMatcherOptions>::registerClass();
  mapper::FactoryOf<CloudOdometryPlugin, CameraOdometryOptions, matching::CloudTrackerOptions,
                    matching::CloudSourceOptions, matching::CloudMatcherOptions, CloudLibraryOptions>::registerClass();
  mapper::FactoryOf<ViewLinksPlugin, ViewLinksOptions>::registerClass();
});

}  // namespace omnimapper::plugins
