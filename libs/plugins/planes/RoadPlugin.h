#pragma once

#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

namespace omnimapper::plugins {

/// perception::RoadExtractor for the worker pool.
class RoadPlugin : public perception::Extractor {
 public:
  RoadPlugin(const perception::RoadOptions& road, const perception::OutlineOptions& outlines,
             const perception::RoadPoseOptions& pose)
      : extractor_(road, outlines, pose) {}

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  perception::RoadExtractor extractor_;
};

class RoadPluginFactory : public mapper::ExtractorFactory {
  DEFINE_MRPT_OBJECT(RoadPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "RoadExtractor"; }
  std::string summary() const override {
    return "The ground of depth images, sloped too, near the one expected from the camera's pose.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                              const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
