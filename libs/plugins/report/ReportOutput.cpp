#include "ReportOutput.h"

#include <omnimapper/derived/LevelFrame.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/derived/ScanGrid.h>

#include "CloudPicture.h"
#include "MapPicture.h"
#include "ReportPage.h"

namespace omnimapper::plugins {

const base::OptionTable<ReportOptions>& ReportOptions::table() {
  using Options = ReportOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("resolution_m", &Options::resolution, {0.005, 10}, "Side of a cell of the grid behind the map.")
          .number("max_range_m", &Options::max_range, {0.1, 1000},
                  "Length up to which beams are entered into the grid.")
          .integer("picture_side_pixels", &Options::picture_side, {200, 8000},
                   "Approximate length of the longer side of the pictures.")
          .integer("max_rows", &Options::max_rows, {0, 1000000},
                   "Largest number of rows of the decision log that the report lists.");
  return table;
}

ReportOutput::ReportOutput(const ReportOptions& options, const mapper::PluginContext& context)
    : options_(options), context_(context) {
  derived::outputPath(context_, "report.html");
}

namespace {
// The map without the observations of a run that only localizes in it.
map::Map mapOnly(const mapper::View& view) {
  map::Map map = view.map;
  if (!view.map_is_held) return map;
  for (const auto& frame : view.map.key_frames) {
    if (frame.id.session == map.sessions.back().number) map.key_frames.edit(frame.id).observations.clear();
  }
  return map;
}
}  // namespace

void ReportOutput::finish(const mapper::View& view) {
  const derived::LevelFrame level(view.map);
  auto trajectory = level(derived::trajectoryOf(view));
  // The trajectory of a run that was never located is not drawn into the map.
  if (view.map_is_held && derived::metricsOf(view, trajectory).located == 0) trajectory.clear();
  const auto closures = level(derived::closuresOf(view.map, view.decisions));
  const auto in_map = derived::shapesOf(view), landmarks = level(in_map);
  derived::ScanGridOptions grid_options;
  grid_options.resolution = options_.resolution;
  grid_options.max_range = options_.max_range;
  grid_options.margin = 0.5;  // walls lie on the border of the observed area
  const auto map = level(mapOnly(view));
  const auto places = placesOf(trajectory, landmarks);
  std::optional<derived::GridPicture> picture;
  // Where the map is drawn as it is, other outputs have the same grid.
  const auto shared = level.isOfMap() && !view.map_is_held ? derived::scanGridOf(view, grid_options) : nullptr;
  if (const auto grid = shared ? *shared : derived::buildScanGrid(map, grid_options)) {
    picture = derived::drawGridToSize(derived::focused(*grid, places), options_.picture_side);
  } else {
    picture = cloudPicture(map, places, options_.picture_side);
  }
  if (!picture) picture = emptyPicture(trajectory, landmarks, 1.0, options_.picture_side);
  if (picture)
    derived::writeBytes(derived::outputPath(context_, "map.png"),
                        draw::encodePng(drawMap(*picture, landmarks, trajectory, closures)));
  const ReportInput input{view,
                          context_,
                          picture ? &*picture : nullptr,
                          trajectory,
                          closures,
                          in_map,
                          landmarks,
                          static_cast<std::size_t>(options_.max_rows)};
  derived::writeBytes(derived::outputPath(context_, "report.html"), drawReport(input));
}

}  // namespace omnimapper::plugins
