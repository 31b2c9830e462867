#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct MapOutputOptions {
  mapper::RawImages keep_raw = mapper::RawImages::none;

  static const base::OptionTable<MapOutputOptions>& table();
};

/// Writes map.omnimap: the map to be loaded again (derived::mapFileToAsk), and the places that queries need. The same
/// log and INI give the same bytes.
class MapOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "MapOutput";
  static constexpr const char* kSummary = "Writes map.omnimap, the whole map, to be loaded again.";

  MapOutput(const MapOutputOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  mapper::RawImages needsOfImages() const override { return keep_raw_; }
  void finish(const mapper::View& view) override;

 private:
  std::string path_;
  mapper::RawImages keep_raw_;
};

}  // namespace omnimapper::plugins
