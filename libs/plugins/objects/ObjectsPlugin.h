#pragma once

#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <atomic>

namespace omnimapper::plugins {

/// perception::ObjectExtractor for the worker pool.
class ObjectsPlugin : public perception::Extractor {
 public:
  explicit ObjectsPlugin(const perception::ObjectExtractor::Options& options)
      : extractor_(options), on_surfaces_only_(options.objects.on_surfaces_only) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;
  /// If no scan showed a level surface.
  std::vector<std::string> warnings() const override;

 private:
  mutable std::atomic<std::size_t> scans_{0}, with_surface_{0};
  perception::ObjectExtractor extractor_;
  bool on_surfaces_only_;
};

class ObjectsPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(ObjectsPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ObjectExtractor"; }
  std::string summary() const override {
    return "Planes of depth images as PlaneExtractor has them, and the things that stand on them.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
