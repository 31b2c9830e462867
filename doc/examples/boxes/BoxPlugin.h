#pragma once

#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

#include "Box.h"
#include "BoxAssociator.h"

namespace boxes {

/// Objects as landmarks: boxes with a class, which a detector finds (CObservationObjects). Boxes that turn out to be
/// one object are merged.
class BoxPlugin : public omnimapper::landmarks::LandmarkPlugin<BoxIndex> {
 public:
  BoxPlugin(const BoxOptions& options, const omnimapper::mapper::PluginContext& context)
      : LandmarkPlugin(BoxIndex(context.section)), options_(options) {}

  bool wants(const mrpt::obs::CObservation& observation) const override;

 protected:
  omnimapper::mapper::Batch associate(const omnimapper::map::KeyFrame& frame,
                                      const omnimapper::mapper::Observed& observed,
                                      const omnimapper::mapper::View& view) override;
  omnimapper::mapper::Batch merge(const omnimapper::mapper::View& view) override;

 private:
  BoxOptions options_;
};

class BoxPluginFactory : public omnimapper::mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(BoxPluginFactory, boxes)
 public:
  std::string name() const override { return "BoxPlugin"; }
  std::string summary() const override { return "Objects as landmarks: boxes with a class."; }
  const std::vector<omnimapper::base::OptionSpec>& options() const override { return BoxOptions::table().specs(); }
  void registerKinds(omnimapper::mapper::Kinds& kinds) const override;
  std::unique_ptr<omnimapper::mapper::MeasurementPlugin> make(
      const omnimapper::base::ConfigSection& section, const omnimapper::mapper::PluginContext& context) const override;
};

}  // namespace boxes
