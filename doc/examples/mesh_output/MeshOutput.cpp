#include "MeshOutput.h"

#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/SceneLandmarks.h>
#include <omnimapper/plugin/FactoryOf.h>

#include <algorithm>

#include "compressed.h"

namespace base = omnimapper::base;
namespace derived = omnimapper::derived;
namespace mapper = omnimapper::mapper;

namespace mesh_output {

namespace {

// A line "v x y z", followed by red, green and blue of [0, 1] if they are wanted, as most readers of the format allow.
std::string vertexLine(const mrpt::opengl::TTriangle& triangle, std::size_t corner, bool with_colour) {
  const auto& at = triangle.vertices[corner].xyzrgba.pt;
  std::string line = "v";
  for (const float metres : {at.x, at.y, at.z}) line += " " + base::fixed(metres, 4);
  if (with_colour) {
    for (const auto channel : {triangle.r(corner), triangle.g(corner), triangle.b(corner)})
      line += " " + base::fixed(channel / 255.0, 3);
  }
  return line + "\n";
}

// "wall_0:12": a name in this format has no blanks.
std::string objectName(const derived::ShapedLandmark& landmark) {
  std::string name = landmark.shape.label + "_" + toString(landmark.landmark->id);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

}  // namespace

const base::OptionTable<MeshOptions>& MeshOptions::table() {
  static const auto table =
      base::OptionTable<MeshOptions>().flag("colours", &MeshOptions::colours, "Writes a colour with each vertex.");
  return table;
}

MeshOutput::MeshOutput(const MeshOptions& options, const mapper::PluginContext& context)
    : options_(options), path_(derived::outputPath(context, "landmarks.obj")) {}

// What a landmark is made of (surfaces with holes, a box, a mesh, lines) is the business of omnimapper::derived.
void MeshOutput::finish(const mapper::View& view) {
  std::string text = "# OmniMapper: landmarks in the map frame, metres\n";
  std::size_t vertices = 0;  // the format counts from 1 through the whole file
  for (const auto& landmark : derived::shapesOf(view)) {
    const auto triangles = derived::landmarkTriangles({landmark});
    if (!triangles.empty()) text += "o " + objectName(landmark) + "\n";
    for (const auto& triangle : triangles) {
      for (std::size_t corner = 0; corner < 3; ++corner) text += vertexLine(triangle, corner, options_.colours);
      text += "f";
      for (int corner = 0; corner < 3; ++corner) text += " " + std::to_string(++vertices);
      text += "\n";
    }
  }
  const auto [bytes, ending] = compressed(text);
  derived::writeBytes(path_ + ending, bytes);
}

// Registers the class when a program loads the library, so that an INI can name it: "class = MeshOutput".
const base::AtLoad kRegister([] { mapper::FactoryOf<MeshOutput, MeshOptions>::registerClass(); });

}  // namespace mesh_output
