#pragma once

#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/interaction/PointingTarget.h>
#include <omnimapper/interaction/readBody.h>
#include <omnimapper/map/LabelEdits.h>
#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/plugin/MeasurementPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <optional>
#include <string>

#include "CarriedLabels.h"
#include "PeopleWatch.h"

namespace omnimapper::plugins {

struct LabelsOptions {
  double patience = 30;         ///< [s] for which a request waits for a gesture (T of the thesis, 6.1.2.2)
  std::string skeletons;        ///< sensor label of the tracker; empty: every tracker
  std::string commands;         ///< sensor label of the commands; empty: all
  std::string pointing_errors;  ///< file of omnimapper-calibrate pointing; empty: `tracker`
  std::string from;             ///< earlier map of the place, or its folder, whose labels are taken over; empty: none
  interaction::SkeletonSoftware tracker = interaction::SkeletonSoftware::openni;

  static const base::OptionTable<LabelsOptions>& table();
};

/// Lets people name things by pointing (thesis 6.2): after a command `label`, the plugin looks for a pointing gesture
/// in the skeletons that come within `patience`, determines the landmark that is meant (interaction::determineTarget())
/// and adds its name to the layer map::Labels. A label for a `place` needs no gesture. If several landmarks may be
/// meant, the layer gets a question, which the edit "choose N" or another gesture answers. Commands `edit` rename,
/// delete and undo. At the end of the run the labels of an earlier map of the place are carried over (carryLabels()).
/// Whatever is asked and answered is in the decision log. The map's z must point up.
class LabelsPlugin : public mapper::MeasurementPlugin, public mapper::WatchesObservations {
 public:
  static constexpr const char* kName = "LabelsPlugin";
  static constexpr const char* kSummary = "Lets people name landmarks by pointing at them, and places.";
  static void registerKinds(mapper::Kinds& kinds);

  LabelsPlugin(const LabelsOptions& options, const interaction::SkeletonFormat& format,
               const interaction::GestureOptions& gestures, const interaction::TargetOptions& targets,
               const mapper::PluginContext& context);

  bool watches(const mrpt::obs::CObservation& observation) const override;
  mapper::WatchResult watch(const mapper::Watched& watched, const mapper::View& view) override;

  // It measures nothing at key frames.
  bool wants(const mrpt::obs::CObservation& /*observation*/) const override { return false; }
  bool worksOnLandmarks() const override { return true; }
  mapper::Batch measure(const map::KeyFrame&, const mapper::Observed&, const mapper::View&) override { return {}; }
  mapper::Batch atEnd(const mapper::View& view) override;

 private:
  struct Request {
    obs::CObservationCommand command;
    double patience = 0;        // [s]
    std::size_t skeletons = 0;  // of use while it waits
    std::string why_not;        // of the last skeleton that is of no use
    base::Stamp examined;       // end of the last gesture that meant nothing
    // The last gesture, in the frame of a key frame: what it means is found anew as the map grows.
    std::optional<interaction::PointingGesture> gesture;
    base::KeyFrameId frame;
    std::size_t key_frames = 0;  // of the map when the gesture was examined
  };
  void take(const obs::CObservationCommand& command, const mapper::Watched& watched, const mapper::View& view,
            mapper::Batch& batch);
  void name(const map::NamedLandmark& named, const obs::CObservationCommand& command, const mapper::Watched& watched,
            const mapper::View& view, mapper::Batch& batch);
  void takeLabel(const obs::CObservationCommand& command, const mapper::Watched& watched, const mapper::View& view,
                 mapper::Batch& batch);
  void look(const mapper::Watched& watched, const mapper::View& view, mapper::Batch& batch);
  void lookAgain(const mapper::View& view, mapper::Batch& batch);
  interaction::TargetVerdict answer(const interaction::PointingGesture& gesture, base::KeyFrameId frame,
                                    const mapper::View& view, mapper::Batch& batch);
  void ask(map::LabelQuestion question, base::Stamp stamp, mapper::Batch& batch);
  void keep(const map::Labels& before, mapper::Batch& batch) const;
  void carry(const mapper::View& view, mapper::Batch& batch);
  void giveUp(base::KeyFrameId frame, base::Stamp stamp, mapper::Batch& batch);
  void log(base::KeyFrameId frame, base::Stamp stamp, bool accepted, const std::string& reason,
           mapper::Batch& batch) const;

  LabelsOptions options_;
  interaction::SkeletonFormat format_;
  interaction::TargetOptions targets_;
  interaction::PointingModel model_;
  std::string section_;
  std::optional<LabelledMap> earlier_;
  PeopleWatch people_;
  map::LabelEdits edits_;
  std::optional<Request> request_;
};

}  // namespace omnimapper::plugins
