#pragma once

#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/plugin/PanTiltOffsets.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

#include "SessionBySigns.h"
#include "SignLandmarksOptions.h"
#include "SignTracks.h"

namespace omnimapper::plugins {

/// Door signs as landmarks (thesis 4.3.2.5): points in space with a text, measured by the directions in which cameras
/// see them (obs::CObservationDoorSigns). A new sign is added once three directions with the same text meet. A
/// measurement is associated by its text first and by its position second.
///
/// A sign that was not seen for `recent_travel` is not associated directly. A new landmark is made instead, and the
/// consistency test gets the hypothesis that both are the same sign; if it accepts this, a loop is closed. A text that
/// is seen at two places yields no such hypothesis. Landmarks that turn out to be the same sign are merged at the end.
class SignLandmarksPlugin : public landmarks::LandmarkPlugin<SignTracks> {
 public:
  static constexpr const char* kName = "SignLandmarksPlugin";
  static constexpr const char* kSummary =
      "Door signs with their texts as landmarks, measured by the directions in which cameras see them.";
  static void registerKinds(mapper::Kinds& kinds);

  SignLandmarksPlugin(const SignLandmarksOptions& options, const mapper::PluginContext& context)
      : LandmarkPlugin(SignTracks(context.section)),
        options_(options),
        context_(context),
        offsets_(options.pan_tilt_offset_sigma, context.section) {}

  bool wants(const mrpt::obs::CObservation& observation) const override;
  void applied(const mapper::AppliedBatch& ids) override;
  /// Proposes which new signs are the same as earlier ones.
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;

 protected:
  mapper::Batch associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                          const mapper::View& view) override;
  mapper::Batch finish(const mapper::View& view) override;

 private:
  SignLandmarksOptions options_;
  mapper::PluginContext context_;
  SessionBySigns session_;
  mapper::PanTiltOffsets offsets_;
};

}  // namespace omnimapper::plugins
