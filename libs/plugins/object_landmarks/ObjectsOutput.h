#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <string>

namespace omnimapper::plugins {

/// This output has no options.
struct ObjectsOptions {
  static const base::OptionTable<ObjectsOptions>& table();
};

/// Writes objects.json, all objects of the map with the evidence for and against them, and into the folder objects the
/// model of each as ID.ply, in the frame of the map, and its picture as ID.png. doc/results/objects.md says what
/// objects.json holds.
class ObjectsOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "ObjectsOutput";
  static constexpr const char* kSummary = "Writes objects.json, and the model and the picture of each object.";

  ObjectsOutput(const ObjectsOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  std::string title_, path_, folder_;
};

}  // namespace omnimapper::plugins
