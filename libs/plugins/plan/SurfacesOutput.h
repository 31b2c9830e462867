#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

/// This output has no options.
struct SurfacesOptions {
  static const base::OptionTable<SurfacesOptions>& table();
};

/// Writes surfaces.json: every flat landmark with its class, plane and outlines in the map frame, in the format in
/// which the simulator writes the true surfaces, so that `omnimapper-eval map` can compare both. Landmarks known only
/// from laser lines have no height and are left out.
class SurfacesOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "SurfacesOutput";
  static constexpr const char* kSummary = "Writes surfaces.json: walls, tables and floors for omnimapper-eval.";

  SurfacesOutput(const SurfacesOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  std::string title_, path_;
};

}  // namespace omnimapper::plugins
