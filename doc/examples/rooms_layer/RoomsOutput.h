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
  explicit RoomsOutput(std::string path) : path_(std::move(path)) {}
  bool isOfMap() const override { return true; }
  void finish(const omnimapper::mapper::View& view) override;

 private:
  std::string path_;
};

class RoomsOutputFactory : public omnimapper::mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(RoomsOutputFactory, rooms_layer)
 public:
  std::string name() const override { return "RoomsOutput"; }
  std::string summary() const override { return "Writes rooms.csv, the named rooms of the map."; }
  const std::vector<omnimapper::base::OptionSpec>& options() const override {
    return RoomsOutputOptions::table().specs();
  }
  std::unique_ptr<omnimapper::mapper::OutputPlugin> make(
      const omnimapper::base::ConfigSection& section, const omnimapper::mapper::PluginContext& context) const override;
};

}  // namespace rooms_layer
