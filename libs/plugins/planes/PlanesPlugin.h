#pragma once

#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::PlaneExtractor for the worker pool.
class PlanesPlugin : public perception::Extractor {
 public:
  PlanesPlugin(const perception::PlaneOptions& planes, const perception::OutlineOptions& outlines,
               const perception::PlaneComparisonOptions& comparison)
      : extractor_(planes, outlines, comparison) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::PlaneExtractor extractor_;
};

class PlanesPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(PlanesPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "PlaneExtractor"; }
  std::string summary() const override { return "Planes of depth images with outlines and covariance."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
