#include "SceneOutput.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/SceneLandmarks.h>
#include <omnimapper/derived/SceneParts.h>
#include <omnimapper/map/DenseTrajectory.h>

namespace omnimapper::plugins {

const base::OptionTable<SceneOptions>& SceneOptions::table() {
  using Options = SceneOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("voxel_m", &Options::voxel, {0, 100},
                  "Side of the cubes in each of which one point is kept; 0 keeps all points.")
          .number("max_range_m", &Options::max_range, {0.1, 1000},
                  "Distance from the sensor beyond which points are left out.")
          .number("corner_spacing_m", &Options::corner_spacing, base::Range::notNegative(),
                  "Distance travelled from one key frame whose axes are drawn to the next.")
          .flag("refused_closures", &Options::refused_closures, "Draws the loop closures that were rejected, too.")
          .flag("names", &Options::names, "Writes the names of landmarks beside them.");
  return table;
}

SceneOutput::SceneOutput(const SceneOptions& options, const mapper::PluginContext& context)
    : options_(options), path_(derived::outputPath(context, "scene.3Dscene")) {}

void SceneOutput::finish(const mapper::View& view) {
  mrpt::opengl::COpenGLScene scene;
  // Mostly ambient light, because colours have a meaning and should hardly depend on the direction of a surface.
  auto& light = scene.getViewport()->lightParameters();
  light.ambient = {0.8f, 0.8f, 0.8f, 1.0f};
  light.diffuse = {0.25f, 0.25f, 0.25f, 1.0f};
  light.specular = {0, 0, 0, 1.0f};
  scene.insert(derived::groundOf(view.map));
  scene.insert(derived::cloudOf(
      derived::pointsOf(view.map, {options_.voxel, options_.max_range, derived::PointColour::automatic})));
  scene.insert(derived::trajectoryLines(map::denseTrajectory(view.map)));
  scene.insert(derived::keyFrameCorners(view.map, options_.corner_spacing));
  const auto closures = derived::closuresOf(view.map, view.decisions);
  scene.insert(derived::closureLines(closures, true));
  if (options_.refused_closures) scene.insert(derived::closureLines(closures, false));
  // Landmarks are inserted last, so that what is behind their translucent surfaces is already drawn.
  scene.insert(derived::landmarkObjects(derived::shapesOf(view), options_.names));
  // The scene is written through memory, because MRPT's own compressed file does not notice a full disk.
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << scene;
  derived::writeBytes(path_, {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()});
}

}  // namespace omnimapper::plugins
