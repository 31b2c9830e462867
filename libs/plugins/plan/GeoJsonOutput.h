#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct GeoJsonOptions {
  bool metres = false;
  bool trajectory = true;

  static const base::OptionTable<GeoJsonOptions>& table();
};

/// Writes floorplan.geojson (RFC 7946), which any GIS or web map opens: upright surfaces and laser lines as
/// LineStrings, all other surfaces as Polygons, points as Points, moved landmarks as the places where they were with
/// the times, and the trajectory of each session. Coordinates are longitude and latitude (WGS84) if GPS gives the map's
/// place on the earth, else metres of the map: a GIS must then be set to no coordinate reference system or to a local
/// one in metres.
class GeoJsonOutput : public mapper::OutputPlugin {
 public:
  GeoJsonOutput(const GeoJsonOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  GeoJsonOptions options_;
  std::string title_, path_;
};

class GeoJsonOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(GeoJsonOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "GeoJsonOutput"; }
  std::string summary() const override {
    return "Writes floorplan.geojson: walls, tables and points for any GIS (geographic information system).";
  }
  const std::vector<base::OptionSpec>& options() const override { return GeoJsonOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
