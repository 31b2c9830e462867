#include "MapOutput.h"

#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/SavedMap.h>

namespace omnimapper::plugins {

const base::OptionTable<MapOutputOptions>& MapOutputOptions::table() {
  using mapper::RawImages;
  static const auto table = base::OptionTable<MapOutputOptions>().choice(
      "keep_raw", &MapOutputOptions::keep_raw,
      {{"none", RawImages::none}, {"depth", RawImages::depth}, {"all", RawImages::all}},
      "Which images of the log are kept with the key frames. none: none of them; a thinned coloured cloud stays. "
      "depth: the depth images. all: all images. What is not kept cannot be recovered from the map later.");
  return table;
}

MapOutput::MapOutput(const MapOutputOptions& options, const mapper::PluginContext& context)
    : path_(derived::outputPath(context, "map.omnimap")), keep_raw_(options.keep_raw) {}

void MapOutput::finish(const mapper::View& view) {
  derived::mapFileToAsk(view).write(path_);
}

}  // namespace omnimapper::plugins
