#pragma once

#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/PanTiltOffsets.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct SignLandmarksOptions : mapper::AssociationOptions {
  std::string label;                                                        ///< empty: signs of every camera
  double min_confidence = 0.8;                                              ///< of a line of text that is used
  double pixel_sigma = 0.5 * base::option_text::kRadiansPerDegree;          ///< [rad] of a direction in the camera
  double pan_sigma = 0.5 * base::option_text::kRadiansPerDegree;            ///< [rad] of the camera's reported pan
  double tilt_sigma = 0.5 * base::option_text::kRadiansPerDegree;           ///< [rad] of the camera's reported tilt
  double pan_tilt_offset_sigma = 3 * base::option_text::kRadiansPerDegree;  ///< [rad] of the unit's zero offsets
  double max_sigma = 2;       ///< [m] largest uncertainty of the position of a new sign
  double recent_travel = 10;  ///< [m] distance travelled during which a sign counts as seen recently
  double same_sigma = 0.03;   ///< [m] between two estimates of the centre of one sign
  double loss_scale = 2;      ///< [sigma] of the Cauchy loss

  static const base::OptionTable<SignLandmarksOptions>& table();
};

/// Door signs as landmarks (thesis 4.3.2.5): points in space with a text, measured by the directions in which cameras
/// see them (obs::CObservationDoorSigns). A new sign is added once three directions with the same text meet. A
/// measurement is associated by its text first and by its position second.
///
/// A sign that was not seen for `recent_travel` is not associated directly. A new landmark is made instead, and the
/// consistency test gets the hypothesis that both are the same sign; if it accepts this, a loop is closed. A text that
/// is seen at two places yields no such hypothesis. Landmarks that turn out to be the same sign are merged at the end.
class SignLandmarksPlugin : public mapper::MeasurementPlugin {
 public:
  SignLandmarksPlugin(const SignLandmarksOptions& options, const mapper::PluginContext& context);
  ~SignLandmarksPlugin() override;

  bool wants(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;
  void restore(const map::MapSection* saved, const mapper::View& view) override;

 private:
  class Work;

  SignLandmarksOptions options_;
  mapper::PluginContext context_;
  std::unique_ptr<class SignTracks> tracks_;
  std::unique_ptr<class SessionBySigns> session_;
  mapper::PanTiltOffsets offsets_;
};

class SignLandmarksPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(SignLandmarksPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "SignLandmarksPlugin"; }
  std::string summary() const override {
    return "Door signs with their texts as landmarks, measured by the directions in which cameras see them.";
  }
  const std::vector<base::OptionSpec>& options() const override { return SignLandmarksOptions::table().specs(); }
  void registerKinds(mapper::Kinds& kinds) const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
