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
  static constexpr const char* kName = "GeoJsonOutput";
  static constexpr const char* kSummary =
      "Writes floorplan.geojson: walls, tables and points for any GIS (geographic information system).";

  GeoJsonOutput(const GeoJsonOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  GeoJsonOptions options_;
  std::string title_, path_;
};

}  // namespace omnimapper::plugins
