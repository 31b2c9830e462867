#pragma once

#include <omnimapper/perception/ArucoMarkerExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::ArucoMarkerExtractor for the worker pool: of pictures, and of range cameras that have one.
class ArucoMarkersPlugin : public perception::Extractor {
 public:
  explicit ArucoMarkersPlugin(const perception::ArucoMarkerOptions& options) : extractor_(options) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::ArucoMarkerExtractor extractor_;
};

class ArucoMarkersPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(ArucoMarkersPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ArucoMarkerExtractor"; }
  std::string summary() const override { return "Square markers with numbers, from pictures, by range and bearing."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
