#pragma once

#include <omnimapper/perception/CloudPlaneExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::CloudPlaneExtractor for the worker pool.
class CloudPlanesPlugin : public perception::Extractor {
 public:
  CloudPlanesPlugin(const perception::CloudPlaneOptions& planes, const perception::CloudSensorOptions& sensors)
      : extractor_(planes, sensors) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::CloudPlaneExtractor extractor_;
};

class CloudPlanesPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(CloudPlanesPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "CloudPlaneExtractor"; }
  std::string summary() const override {
    return "Planes of point clouds without order, such as those of 3D lasers, with outlines and covariance.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
