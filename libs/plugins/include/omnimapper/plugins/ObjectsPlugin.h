#pragma once

#include <omnimapper/mapper/PluginFactory.h>
#include <omnimapper/perception/ObjectExtractor.h>

namespace omnimapper::plugins {

/// perception::ObjectExtractor for the worker pool.
class ObjectsPlugin : public mapper::Extractor {
 public:
  explicit ObjectsPlugin(const perception::ObjectExtractor::Options& options) : extractor_(options) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::ObjectExtractor extractor_;
};

class ObjectsPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(ObjectsPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ObjectExtractor"; }
  std::string summary() const override {
    return "Planes of depth images as PlaneExtractor has them, and the things that stand on them.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::Extractor> make(const base::ConfigSection& section,
                                          const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
