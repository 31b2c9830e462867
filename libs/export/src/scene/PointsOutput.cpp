#include "scene/PointsOutput.h"

#include "run/OutputFile.h"
#include "scene/MapPoints.h"
#include "scene/Ply.h"
#include "scene/SceneLandmarks.h"

IMPLEMENTS_MRPT_OBJECT(PointsOutputFactory, omnimapper::mapper::OutputPluginFactory, omnimapper::exports)

namespace omnimapper::exports {

const base::OptionTable<PointsOptions>& PointsOptions::table() {
  using Options = PointsOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("voxel_m", &Options::voxel, {0, 100},
                  "Side of the cubes in each of which one point is kept; 0 keeps all points.")
          .number("max_range_m", &Options::max_range, {0.1, 1000},
                  "Distance from the sensor beyond which points are left out.")
          .choice(
              "colour", &Options::colour,
              {{"auto", PointColour::automatic}, {"height", PointColour::height}, {"time", PointColour::time}},
              "What the colours of the points show: the height or the time of each point. auto: the camera's colours "
              "if there are depth images, else the height if the points are not all at one height, else the time.");
  return table;
}

PointsOutput::PointsOutput(const PointsOptions& options, const mapper::PluginContext& context)
    : options_(options),
      path_(outputPath(context, "points.ply")),
      landmarks_path_(outputPath(context, "landmarks.ply")) {}

void PointsOutput::finish(const mapper::View& view) {
  const auto points = pointsOf(view.map, options_);
  if (!points.empty()) writeBytes(path_, encodePly(points));
  const auto landmarks = landmarkTriangles(shapesOf(view));
  if (!landmarks.empty()) writeBytes(landmarks_path_, encodePly(landmarks));
}

std::unique_ptr<mapper::OutputPlugin> PointsOutputFactory::make(const base::ConfigSection& section,
                                                                const mapper::PluginContext& context) const {
  return std::make_unique<PointsOutput>(section.read<PointsOptions>(mapper::sectionKeysOfEngine()), context);
}

}  // namespace omnimapper::exports
