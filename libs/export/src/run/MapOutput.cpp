#include "run/MapOutput.h"

#include <omnimapper/mapper/SavedMap.h>

#include "run/OutputFile.h"

IMPLEMENTS_MRPT_OBJECT(MapOutputFactory, omnimapper::mapper::OutputPluginFactory, omnimapper::exports)

namespace omnimapper::exports {

const base::OptionTable<MapOutputOptions>& MapOutputOptions::table() {
  static const base::OptionTable<MapOutputOptions> table;
  return table;
}

MapOutput::MapOutput(const MapOutputOptions&, const mapper::PluginContext& context)
    : path_(outputPath(context, "map.omnimap")) {}

void MapOutput::finish(const mapper::View& view) {
  mapper::mapFileOf(view.map, view.graph, view.sections).write(path_);
}

std::unique_ptr<mapper::OutputPlugin> MapOutputFactory::make(const base::ConfigSection& section,
                                                             const mapper::PluginContext& context) const {
  return std::make_unique<MapOutput>(section.read<MapOutputOptions>(mapper::sectionKeysOfEngine()), context);
}

}  // namespace omnimapper::exports
