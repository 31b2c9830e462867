#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "ArucoMarkerExtractor.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<perception::ArucoMarkerExtractor, perception::ArucoMarkerOptions>::registerClass();
});

}  // namespace omnimapper::plugins
