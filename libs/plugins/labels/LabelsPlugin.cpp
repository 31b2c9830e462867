#include "LabelsPlugin.h"

#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/derived/PlacesOfMap.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <utility>

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

geometry::Se3 poseOf(const map::KeyFrame& frame) {
  return geometry::fromMrpt(frame.map_from_base);
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
          .text("from", &O::from,
                "Map of the same place, or its folder, whose labels the map has at the end, too; empty for none. Both "
                "need rooms, so RoomsPlugin must be listed before.")
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
      people_(gestures) {
  if (!options_.from.empty()) earlier_ = readLabelledMap(options_.from);
}

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
  if (request_ && base::secondsBetween(request_->command.timestamp, stamp) > request_->patience) {
    lookAgain(view, result.batch);
    if (request_) giveUp(watched.pose->frame, stamp, result.batch);
  }
  if (const auto* command = dynamic_cast<const CObservationCommand*>(&watched.observation))
    take(*command, watched, view, result.batch);
  else
    look(watched, view, result.batch);
  lookAgain(view, result.batch);
  keep(before, result.batch);
  return result;
}

// A map without labels has no layer.
void LabelsPlugin::keep(const map::Labels& before, mapper::Batch& batch) const {
  const map::Labels& now = edits_.now();
  if (now.toBytes() == before.toBytes()) return;
  if (now.labels.empty() && !now.question)
    batch.removeLayer(map::Labels::kLayer);
  else
    batch.setLayer(now);
}

void LabelsPlugin::take(const CObservationCommand& command, const mapper::Watched& watched, const mapper::View& view,
                        mapper::Batch& batch) {
  if (command.kind == obs::CommandKind::label) return takeLabel(command, watched, view, batch);
  if (const auto named = map::namedLandmark(command.text)) return name(*named, command, watched, view, batch);
  const bool was_asked = edits_.now().question.has_value();
  const auto outcome = edits_.edit(command.text);
  if (was_asked && !edits_.now().question) request_.reset();  // answered
  log(watched.pose->frame, command.timestamp, outcome.is_done, outcome.text, batch);
}

// Who touches a thing on a page needs no gesture.
void LabelsPlugin::name(const map::NamedLandmark& named, const CObservationCommand& command,
                        const mapper::Watched& watched, const mapper::View& view, mapper::Batch& batch) {
  const base::KeyFrameId frame = watched.pose->frame;
  const auto refuseIt = [&](const std::string& why) { log(frame, command.timestamp, false, why, batch); };
  if (const auto why = map::whyNoLabel(named.text)) return refuseIt("the label " + shown(named.text) + " " + *why);
  const auto all = labelCandidates(view, obs::CommandSubject::any);
  const auto found = std::find(all.landmarks.begin(), all.landmarks.end(), named.id);
  if (found == all.landmarks.end()) return refuseIt("there is no landmark " + toString(named.id) + " to be named");
  const auto& candidate = all.candidates[static_cast<std::size_t>(found - all.landmarks.begin())];
  const Eigen::Vector3d point = inverse(poseOf(view.map.keyFrame(frame))) * middleOf(candidate);
  map::Label label{named.text, named.id, frame, point, base::printable(command.origin), command.timestamp, 1};
  if (edits_.has(label)) return refuseIt("it is called " + shown(named.text) + " already");
  edits_.add(std::move(label));
  log(frame, command.timestamp, true, shown(named.text) + " is landmark " + toString(named.id), batch);
}

void LabelsPlugin::takeLabel(const CObservationCommand& command, const mapper::Watched& watched,
                             const mapper::View& view, mapper::Batch& batch) {
  const base::KeyFrameId frame = watched.pose->frame;
  if (const auto why = map::whyNoLabel(command.text))
    return log(frame, command.timestamp, false, "the label " + shown(command.text) + " " + *why, batch);
  if (request_) lookAgain(view, batch);
  if (request_) giveUp(frame, command.timestamp, batch);
  if (command.subject != obs::CommandSubject::place) {
    edits_.forgetQuestion();
    Request request;
    request.command = command;
    request.patience = command.expiry > 0 ? command.expiry : options_.patience;
    request_ = std::move(request);
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
  // While an arm is held still, it is examined anew when all of its skeletons are new.
  if (gestures.empty() || gestures.front().begin < request_->examined) return;
  const PointingGesture& gesture = gestures.front();
  const base::KeyFrameId frame = watched.pose->frame;
  request_->frame = frame;
  request_->gesture = interaction::transformed(inverse(poseOf(view.map.keyFrame(frame))), gesture);
  request_->examined = gesture.end;
  if (answer(gesture, frame, view, batch) != TargetVerdict::nothing) people_.understood(gesture);
}

// What was pointed at may have been mapped since.
void LabelsPlugin::lookAgain(const mapper::View& view, mapper::Batch& batch) {
  if (!request_ || !request_->gesture || request_->key_frames == view.map.key_frames.size()) return;
  const auto& frame = view.map.keyFrame(request_->frame);
  answer(interaction::transformed(poseOf(frame), *request_->gesture), frame.id, view, batch);
}

TargetVerdict LabelsPlugin::answer(const PointingGesture& gesture, base::KeyFrameId frame, const mapper::View& view,
                                   mapper::Batch& batch) {
  const CObservationCommand command = request_->command;
  request_->key_frames = view.map.key_frames.size();
  const auto found = labelCandidates(view, command.subject);
  const auto target = interaction::determineTarget(gesture, found.candidates, model_, targets_);
  const auto frame_from_map = inverse(poseOf(view.map.keyFrame(frame)));
  const auto choiceOf = [&](std::size_t i) {
    return map::LabelQuestion::Choice{found.landmarks[i], frame_from_map * middleOf(found.candidates[i]),
                                      target.probabilities[i]};
  };
  const std::string who = base::printable(command.origin);
  if (target.verdict == TargetVerdict::this_one) {
    const auto choice = choiceOf(target.candidates.front());
    edits_.add({command.text, choice.landmark, frame, choice.in_frame, who, command.timestamp, choice.probability});
    log(frame, gesture.end, true,
        shown(command.text) + " is landmark " + toString(choice.landmark) + ", with probability " +
            base::fixed(choice.probability, 3),
        batch);
    request_.reset();
  } else if (target.verdict == TargetVerdict::one_of_these) {
    map::LabelQuestion question{command.text, who, command.timestamp, frame, {}};
    for (const std::size_t i : target.candidates) question.choices.push_back(choiceOf(i));
    ask(std::move(question), gesture.end, batch);
  }
  return target.verdict;
}

void LabelsPlugin::ask(map::LabelQuestion question, base::Stamp stamp, mapper::Batch& batch) {
  const auto which = [](const map::LabelQuestion& asked) {
    std::string list;
    for (const auto& choice : asked.choices) list += (list.empty() ? "" : ", ") + toString(choice.landmark);
    return list;
  };
  const auto& before = edits_.now().question;
  const bool is_known = before && before->text == question.text && which(*before) == which(question);
  if (!is_known)
    log(question.frame, stamp, false,
        shown(question.text) + " may be each of the landmarks " + which(question) + ": which?", batch);
  edits_.ask(std::move(question));
}

void LabelsPlugin::giveUp(base::KeyFrameId frame, base::Stamp stamp, mapper::Batch& batch) {
  std::string why = request_->skeletons == 0 ? "nobody was seen" : "nobody pointed at anything that is mapped";
  if (edits_.now().question) why = "the question was not answered";
  if (!request_->why_not.empty()) why += " (" + request_->why_not + ")";
  log(frame, stamp, false, "the label " + shown(request_->command.text) + " was not given: " + why, batch);
  edits_.forgetQuestion();
  request_.reset();
}

// The labels of the earlier map that this one does not have yet.
void LabelsPlugin::carry(const mapper::View& view, mapper::Batch& batch) {
  const auto& last = view.map.key_frames.back();
  const std::size_t count = earlier_->labels.labels.size();
  const auto refuseAll = [&](const std::string& why) {
    log(last.id, last.stamp, false,
        "the " + base::counted(count, "label") + " of " + options_.from + " were not taken over: " + why, batch);
  };
  if (count == 0) return refuseAll("there are none");
  LabelledMap now{{}, derived::placesOf(view), std::nullopt};
  if (const auto layer = view.map.layers.find(building::kRoomsLayer))
    now.rooms = building::decodeRooms(layer->bytes(), "the rooms of the map").building.storeys.front();
  const auto motion = motionBetweenMaps(*earlier_, now);
  if (!motion) return refuseAll("the rooms of both maps are not the same, or one has none");
  const CarriedLabels carried = carryLabels(*earlier_, now, *motion, view.map.key_frames);
  for (const map::Label& label : carried.labels)
    if (!edits_.has(label)) edits_.add(label);
  for (const auto& [text, why_not] : carried.outcomes)
    log(last.id, last.stamp, why_not.empty(),
        shown(text) +
            (why_not.empty() ? " is taken over from " + options_.from : " could not be taken over: " + why_not),
        batch);
}

mapper::Batch LabelsPlugin::atEnd(const mapper::View& view) {
  mapper::Batch batch;
  if (view.map_is_held || view.map.key_frames.size() == 0) return batch;
  const auto* saved = view.map.layers.find<map::Labels>();
  const map::Labels before = saved ? *saved : map::Labels();
  edits_.begin(before);
  lookAgain(view, batch);
  if (request_) giveUp(view.map.key_frames.back().id, view.map.key_frames.back().stamp, batch);
  if (earlier_) carry(view, batch);
  keep(before, batch);
  return batch;
}

}  // namespace omnimapper::plugins
