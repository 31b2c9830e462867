#pragma once

#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::LaserPointsExtractor for the worker pool.
class LaserPointsPlugin : public perception::Extractor {
 public:
  explicit LaserPointsPlugin(const perception::LaserPointsOptions& options) : extractor_(options) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::LaserPointsExtractor extractor_;
};

class LaserPointsPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(LaserPointsPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "LaserPointsExtractor"; }
  std::string summary() const override { return "Valid beams of 2D scans as evenly spaced points."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
