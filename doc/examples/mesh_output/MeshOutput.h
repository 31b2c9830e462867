#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace mesh_output {

/// What a user can set; the table declares each key once.
struct MeshOptions {
  bool colours = true;  ///< the colour of its class is written with each vertex

  static const omnimapper::base::OptionTable<MeshOptions>& table();
};

/// Writes landmarks.obj.gz, or landmarks.obj without zlib: the landmarks of the map as a mesh in the Wavefront format,
/// one object for each, in the frame of the map [m]. Moved landmarks are left out.
class MeshOutput : public omnimapper::mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "MeshOutput";
  static constexpr const char* kSummary = "Writes landmarks.obj.gz, the landmarks as a mesh.";

  MeshOutput(const MeshOptions& options, const omnimapper::mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const omnimapper::mapper::View& view) override;

 private:
  MeshOptions options_;
  std::string path_;  // without ".gz"
};

}  // namespace mesh_output
