#include "GeoJsonOutput.h"

#include <omnimapper/derived/OutputFile.h>

#include "GeoJson.h"

namespace omnimapper::plugins {

const base::OptionTable<GeoJsonOptions>& GeoJsonOptions::table() {
  using Options = GeoJsonOptions;
  static const auto table =
      base::OptionTable<Options>()
          .flag("metres", &Options::metres, "Writes x and y in metres even where GPS provides longitude and latitude.")
          .flag("trajectory", &Options::trajectory, "Writes the trajectory of each session, too.");
  return table;
}

GeoJsonOutput::GeoJsonOutput(const GeoJsonOptions& options, const mapper::PluginContext& context)
    : options_(options), title_(context.title), path_(derived::outputPath(context, "floorplan.geojson")) {}

void GeoJsonOutput::finish(const mapper::View& view) {
  derived::writeBytes(path_, encodeGeoJson({view, title_, options_.metres, options_.trajectory}));
}

}  // namespace omnimapper::plugins
