#pragma once

#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::LaserLineExtractor for the worker pool.
class LaserLinesPlugin : public perception::Extractor {
 public:
  explicit LaserLinesPlugin(const perception::LaserLineOptions& options) : extractor_(options) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::LaserLineExtractor extractor_;
};

class LaserLinesPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(LaserLinesPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "LaserLineExtractor"; }
  std::string summary() const override { return "Straight walls of 2D scans as lines with ends and covariance."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
