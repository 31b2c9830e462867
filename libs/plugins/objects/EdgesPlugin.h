#pragma once

#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::EdgeExtractor for the worker pool.
class EdgesPlugin : public perception::Extractor {
 public:
  explicit EdgesPlugin(const perception::EdgeOptions& options) : extractor_(options) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::EdgeExtractor extractor_;
};

class EdgesPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(EdgesPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "EdgeExtractor"; }
  std::string summary() const override {
    return "3D edges of depth images and their pictures, a cloud of points for each kind.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
