#include "GridOutput.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/derived/MapServer.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/ScanGrid.h>

#include <algorithm>

namespace omnimapper::plugins {

const base::OptionTable<GridOptions>& GridOptions::table() {
  using Options = GridOptions;
  static const auto table = base::OptionTable<Options>()
                                .number("resolution_m", &Options::resolution, {0.005, 10}, "Side of a grid cell.")
                                .number("max_range_m", &Options::max_range, {0.1, 1000},
                                        "Length up to which beams are entered into the grid.")
                                .number("margin_m", &Options::margin, {0, 1000},
                                        "Width of the margin of unknown cells around the observed area.")
                                .integer("max_megacells", &Options::max_megacells, {1, 2000},
                                         "Memory limit of the grid in millions of cells. If the map needs more, the "
                                         "cells are made larger; grid.yaml states their side.");
  return table;
}

GridOutput::GridOutput(const GridOptions& options, const mapper::PluginContext& context)
    : options_(options), path_(derived::outputPath(context, "grid")) {}

void GridOutput::finish(const mapper::View& view) {
  const auto shared = derived::scanGridOf(
      view, {options_.resolution, options_.max_range, options_.margin, 1e6 * options_.max_megacells});
  const auto& grid = *shared;
  if (!grid) return;
  constexpr double kCoarsest = 1;  // [m] in coarser cells walls cannot be distinguished
  if (grid->resolution > std::max(kCoarsest, options_.resolution)) {
    throw base::Error(base::ExitCode::out_of_memory,
                      path_ + ".pgm: not written: the map is " + base::brief(grid->maxX() - grid->min_x) + " m by " +
                          base::brief(grid->maxY() - grid->min_y) + " m; with " +
                          std::to_string(options_.max_megacells) + " million cells a cell would be as wide as " +
                          base::brief(grid->resolution) +
                          " m. Does the trajectory jump? If not, raise [grid] max_megacells.");
  }
  derived::writeBytes(path_ + ".pgm", derived::encodePgm(*grid));
  derived::writeBytes(path_ + ".yaml", derived::encodeMapServerYaml(*grid, "grid.pgm", options_.resolution));
  derived::writeBytes(path_ + ".png", draw::encodePng(derived::drawGrid(*grid).image));
}

}  // namespace omnimapper::plugins
