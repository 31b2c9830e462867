#include "SurfacesOutput.h"

#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/ThingsOfMap.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/surfaces/SurfaceSet.h>

namespace omnimapper::plugins {

const base::OptionTable<SurfacesOptions>& SurfacesOptions::table() {
  static const base::OptionTable<SurfacesOptions> table;
  return table;
}

SurfacesOutput::SurfacesOutput(const SurfacesOptions&, const mapper::PluginContext& context)
    : title_(context.title), path_(derived::outputPath(context, "surfaces.json")) {}

void SurfacesOutput::finish(const mapper::View& view) {
  surfaces::SurfaceSet set;
  set.title = title_;
  if (const auto* level = view.map.layers.find<map::Level>())
    set.level = surfaces::SurfaceSetLevel{level->up, toString(level->source), level->standardDeviation()};
  for (const auto& shaped : derived::shapesOf(view, derived::Candidates::kept)) {
    if (shaped.moved || shaped.shape.surfaces.empty()) continue;
    set.surfaces.push_back(derived::surfaceOf(shaped));
    set.surfaces.back().id = static_cast<int>(set.surfaces.size());
  }
  derived::writeBytes(path_, surfaces::toJson(set));
}

}  // namespace omnimapper::plugins
