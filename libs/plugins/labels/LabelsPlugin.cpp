#include "LabelsPlugin.h"

#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/Conversions.h>

#include "LabelCandidates.h"

namespace omnimapper::plugins {

namespace {

using interaction::PointingGesture;
using interaction::TargetVerdict;
using mrpt::obs::CObservationSkeleton;
using obs::CObservationCommand;

std::string shown(const std::string& text) {
  constexpr std::size_t kMost = 60;
  return "'" + base::printable(text.substr(0, kMost)) + (text.size() > kMost ? "...'" : "'");
}

Eigen::Vector3d inFrame(const map::KeyFrame& frame, const Eigen::Vector3d& in_map) {
  return geometry::inverse(geometry::fromMrpt(frame.map_from_base)) * in_map;
}

interaction::PointingModel modelOf(const LabelsOptions& options) {
  return options.pointing_errors.empty() ? interaction::thesisModel(options.tracker)
                                         : interaction::readPointingModel(options.pointing_errors);
}

}  // namespace

const base::OptionTable<LabelsOptions>& LabelsOptions::table() {
  using O = LabelsOptions;
  static const auto table =
      base::OptionTable<O>()
          .number("patience_s", &O::patience, base::Range::positive(),
                  "Time for which a label waits for a gesture, if the command does not state one.")
          .text("skeletons", &O::skeletons, "Sensor label of the tracker of people; empty for every tracker.")
          .text("commands", &O::commands, "Sensor label of the commands; empty for all.")
          .text("pointing_errors", &O::pointing_errors,
                "File pointing.csv of omnimapper-calibrate pointing; empty for the tables of `tracker`.")
          .choice(
              "tracker", &O::tracker,
              {{"openni", interaction::SkeletonSoftware::openni}, {"ms_sdk", interaction::SkeletonSoftware::ms_sdk}},
              "Tracker whose errors of pointing, as the thesis measured them, are expected.");
  return table;
}

void LabelsPlugin::registerKinds(mapper::Kinds& kinds) {
  kinds.layers.add<map::Labels>();
}

LabelsPlugin::LabelsPlugin(const LabelsOptions& options, const interaction::SkeletonFormat& format,
                           const interaction::GestureOptions& gestures, const interaction::TargetOptions& targets,
                           const mapper::PluginContext& context)
    : options_(options),
      format_(format),
      targets_(targets),
      model_(modelOf(options)),
      section_(context.section),
      people_(gestures) {}

bool LabelsPlugin::watches(const mrpt::obs::CObservation& observation) const {
  const auto isFrom = [&](const std::string& label) { return label.empty() || observation.sensorLabel == label; };
  if (dynamic_cast<const CObservationSkeleton*>(&observation)) return isFrom(options_.skeletons);
  const auto* command = dynamic_cast<const CObservationCommand*>(&observation);
  return command && isFrom(options_.commands) &&
         (command->kind == obs::CommandKind::label || command->kind == obs::CommandKind::edit);
}

void LabelsPlugin::log(base::KeyFrameId frame, base::Stamp stamp, bool accepted, const std::string& reason,
                       mapper::Batch& batch) const {
  mapper::Decision decision;
  decision.stamp = stamp;
  decision.plugin = section_;
  decision.kind = "label";
  decision.from = frame;
  decision.accepted = accepted;
  decision.reason = reason;
  batch.log(std::move(decision));
}

mapper::WatchResult LabelsPlugin::watch(const mapper::Watched& watched, const mapper::View& view) {
  mapper::WatchResult result;
  // Before the first key frame there is nothing to name, and a run that only localizes does not change its map.
  if (!watched.pose || view.map_is_held) return result;
  const auto* saved = view.map.layers.find<map::Labels>();
  const map::Labels before = saved ? *saved : map::Labels();
  edits_.begin(before);
  const base::Stamp stamp = watched.observation.timestamp;
  if (request_ && base::secondsBetween(request_->command.timestamp, stamp) > request_->patience)
    giveUp(watched.pose->frame, stamp, result.batch);
  if (const auto* command = dynamic_cast<const CObservationCommand*>(&watched.observation))
    take(*command, watched, result.batch);
  else
    look(watched, view, result.batch);
  if (edits_.now().toBytes() != before.toBytes()) result.batch.setLayer(edits_.now());
  return result;
}

void LabelsPlugin::take(const CObservationCommand& command, const mapper::Watched& watched, mapper::Batch& batch) {
  if (command.kind == obs::CommandKind::label) return takeLabel(command, watched, batch);
  const bool was_asked = edits_.now().question.has_value();
  const auto outcome = edits_.edit(command.text);
  if (was_asked && !edits_.now().question) request_.reset();  // answered
  log(watched.pose->frame, command.timestamp, outcome.is_done, outcome.text, batch);
}

void LabelsPlugin::takeLabel(const CObservationCommand& command, const mapper::Watched& watched, mapper::Batch& batch) {
  const base::KeyFrameId frame = watched.pose->frame;
  if (const auto why = whyNoLabel(command.text))
    return log(frame, command.timestamp, false, "the label " + shown(command.text) + " " + *why, batch);
  if (request_) giveUp(frame, command.timestamp, batch);
  if (command.subject != obs::CommandSubject::place) {
    edits_.forgetQuestion();
    request_ = Request{command, command.expiry > 0 ? command.expiry : options_.patience, 0, "", {}};
    return;
  }
  const auto& at = watched.pose->frame_from_base.begin_from_end;
  edits_.add(
      {command.text, {}, frame, {at.x(), at.y(), at.z()}, base::printable(command.origin), command.timestamp, 1});
  log(frame, command.timestamp, true, shown(command.text) + " is this place", batch);
}

void LabelsPlugin::look(const mapper::Watched& watched, const mapper::View& view, mapper::Batch& batch) {
  if (!request_) return;
  const auto reading = interaction::readBody(dynamic_cast<const CObservationSkeleton&>(watched.observation), format_);
  if (!reading.body) {
    request_->why_not = reading.why_not;
    return;
  }
  ++request_->skeletons;
  if (interaction::looksAway(*reading.body)) request_->why_not = "the person looks away, or the tracker is mirrored";
  const auto body = interaction::transformed(geometry::fromMrpt(watched.pose->map_from_base), *reading.body);
  const auto gestures = people_.add(watched.observation.timestamp, body);
  if (!gestures.empty()) answer(gestures.front(), *watched.pose, view, batch);
}

void LabelsPlugin::answer(const PointingGesture& gesture, const mapper::WatchedPose& pose, const mapper::View& view,
                          mapper::Batch& batch) {
  // While an arm is held still, it is examined anew when all of its skeletons are new.
  if (gesture.begin < request_->examined) return;
  const CObservationCommand& command = request_->command;
  const auto found = labelCandidates(view, command.subject);
  const auto target = interaction::determineTarget(gesture, found.candidates, model_, targets_);
  if (target.verdict == TargetVerdict::nothing) {
    request_->examined = gesture.end;  // another gesture may come
    return;
  }
  const map::KeyFrame& frame = view.map.keyFrame(pose.frame);
  const auto choiceOf = [&](std::size_t i) {
    return map::LabelQuestion::Choice{found.landmarks[i], inFrame(frame, middleOf(found.candidates[i])),
                                      target.probabilities[i]};
  };
  people_.understood(gesture);
  if (target.verdict == TargetVerdict::this_one) {
    const auto choice = choiceOf(target.candidates.front());
    edits_.add({command.text, choice.landmark, pose.frame, choice.in_frame, base::printable(command.origin),
                command.timestamp, choice.probability});
    log(pose.frame, gesture.end, true,
        shown(command.text) + " is landmark " + toString(choice.landmark) + ", with probability " +
            base::fixed(choice.probability, 3),
        batch);
    request_.reset();
    return;
  }
  map::LabelQuestion question{command.text, base::printable(command.origin), command.timestamp, pose.frame, {}};
  std::string which;
  for (const std::size_t i : target.candidates) {
    question.choices.push_back(choiceOf(i));
    which += (which.empty() ? "" : ", ") + toString(found.landmarks[i]);
  }
  edits_.ask(std::move(question));
  log(pose.frame, gesture.end, false, shown(command.text) + " may be each of the landmarks " + which + ": which?",
      batch);
}

void LabelsPlugin::giveUp(base::KeyFrameId frame, base::Stamp stamp, mapper::Batch& batch) {
  std::string why = request_->skeletons == 0 ? "nobody was seen" : "nobody pointed at anything that is mapped";
  if (edits_.now().question) why = "the question was not answered";
  if (!request_->why_not.empty()) why += " (" + request_->why_not + ")";
  log(frame, stamp, false, "the label " + shown(request_->command.text) + " was not given: " + why, batch);
  edits_.forgetQuestion();
  request_.reset();
}

mapper::Batch LabelsPlugin::atEnd(const mapper::View& view) {
  mapper::Batch batch;
  if (!request_ || view.map_is_held || view.map.key_frames.size() == 0) return batch;
  base::KeyFrameId last{};
  base::Stamp stamp;
  for (const auto& frame : view.map.key_frames) last = frame.id, stamp = frame.stamp;
  const auto* saved = view.map.layers.find<map::Labels>();
  edits_.begin(saved ? *saved : map::Labels());
  giveUp(last, stamp, batch);
  batch.setLayer(edits_.now());
  return batch;
}

}  // namespace omnimapper::plugins
