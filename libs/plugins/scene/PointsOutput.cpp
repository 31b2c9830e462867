#include "PointsOutput.h"

#include <omnimapper/derived/MapPoints.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/Ply.h>
#include <omnimapper/derived/SceneLandmarks.h>

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

}  // namespace omnimapper::plugins
