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
  MapOutput(const MapOutputOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  mapper::RawImages needsOfImages() const override { return keep_raw_; }
  void finish(const mapper::View& view) override;

 private:
  std::string path_;
  mapper::RawImages keep_raw_;
};

class MapOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(MapOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "MapOutput"; }
  std::string summary() const override { return "Writes map.omnimap, the whole map, to be loaded again."; }
  const std::vector<base::OptionSpec>& options() const override { return MapOutputOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
