#include "PointsOutput.h"

#include <omnimapper/derived/MapPoints.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/Ply.h>
#include <omnimapper/derived/SceneLandmarks.h>

IMPLEMENTS_MRPT_OBJECT(PointsOutputFactory, omnimapper::mapper::OutputPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

PointsOutput::PointsOutput(const derived::PointsOptions& options, const mapper::PluginContext& context)
    : options_(options),
      path_(derived::outputPath(context, "points.ply")),
      landmarks_path_(derived::outputPath(context, "landmarks.ply")) {}

void PointsOutput::finish(const mapper::View& view) {
  const auto points = derived::pointsOf(view.map, options_);
  if (!points.empty()) derived::writeBytes(path_, derived::encodePly(points));
  const auto landmarks = derived::landmarkTriangles(derived::shapesOf(view));
  if (!landmarks.empty()) derived::writeBytes(landmarks_path_, derived::encodePly(landmarks));
}

std::unique_ptr<mapper::OutputPlugin> PointsOutputFactory::make(const base::ConfigSection& section,
                                                                const mapper::PluginContext& context) const {
  return std::make_unique<PointsOutput>(section.read<derived::PointsOptions>(mapper::sectionKeysOfEngine()), context);
}

}  // namespace omnimapper::plugins
