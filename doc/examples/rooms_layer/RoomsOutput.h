#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace rooms_layer {

struct RoomsOutputOptions {
  std::string file = "rooms.csv";

  static const omnimapper::base::OptionTable<RoomsOutputOptions>& table();
};

// Step 3: an output that shows the layer. It finds the layer by its type, and knows nothing of the plugin that sets it.

/// Writes rooms.csv: for each room when its tag was read (Unix time [s]), where in the map [m], and its name.
class RoomsOutput : public omnimapper::mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "RoomsOutput";
  static constexpr const char* kSummary = "Writes rooms.csv, the named rooms of the map.";

  RoomsOutput(const RoomsOutputOptions& options, const omnimapper::mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const omnimapper::mapper::View& view) override;

 private:
  std::string path_;
};

}  // namespace rooms_layer
