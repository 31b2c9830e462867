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
  static constexpr const char* kName = "BoxPlugin";
  static constexpr const char* kSummary = "Objects as landmarks: boxes with a class.";
  static void registerKinds(omnimapper::mapper::Kinds& kinds);

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

}  // namespace boxes
