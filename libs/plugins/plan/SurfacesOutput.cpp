#include "SurfacesOutput.h"

#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/surfaces/SurfaceSet.h>

namespace omnimapper::plugins {

const base::OptionTable<SurfacesOptions>& SurfacesOptions::table() {
  static const base::OptionTable<SurfacesOptions> table;
  return table;
}

namespace {

surfaces::Surface surfaceOf(const derived::ShapedLandmark& shaped, int id) {
  const map::LandmarkShape& shape = shaped.shape;
  surfaces::Surface surface;
  surface.id = id;
  surface.name = toString(shaped.landmark->id);
  surface.is = surfaces::surfaceClassNamed(shape.label).value_or(surfaces::SurfaceClass::surface);
  surface.reason = shape.reason;
  surface.is_candidate = shape.is_candidate;
  surface.measurements = static_cast<int>(shaped.landmark->evidence);
  surface.plane = derived::planeOf(shape.surfaces.front(), shape);
  for (std::size_t i = 0; i < shape.surfaces.size(); ++i) {
    const auto walks = derived::withHoles(i, shape);
    surfaces::FlatPart& part = surface.parts.emplace_back();
    part.outline = walks.front().vertices;
    for (std::size_t hole = 1; hole < walks.size(); ++hole) part.holes.push_back(walks[hole].vertices);
  }
  return surface;
}

}  // namespace

SurfacesOutput::SurfacesOutput(const SurfacesOptions&, const mapper::PluginContext& context)
    : title_(context.title), path_(derived::outputPath(context, "surfaces.json")) {}

void SurfacesOutput::finish(const mapper::View& view) {
  surfaces::SurfaceSet set;
  set.title = title_;
  if (const auto* level = view.map.layers.find<map::Level>())
    set.level = surfaces::SurfaceSetLevel{level->up, toString(level->source), level->standardDeviation()};
  for (const auto& shaped : derived::shapesOf(view, derived::Candidates::kept)) {
    if (shaped.moved || shaped.shape.surfaces.empty()) continue;
    set.surfaces.push_back(surfaceOf(shaped, static_cast<int>(set.surfaces.size()) + 1));
  }
  derived::writeBytes(path_, surfaces::toJson(set));
}

}  // namespace omnimapper::plugins
