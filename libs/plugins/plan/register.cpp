#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "GeoJsonOutput.h"
#include "SurfacesOutput.h"

namespace omnimapper::plugins {

const base::AtLoad kRegister([] {
  mapper::FactoryOf<GeoJsonOutput, GeoJsonOptions>::registerClass();
  mapper::FactoryOf<SurfacesOutput, SurfacesOptions>::registerClass();
});

}  // namespace omnimapper::plugins
