#include "NewSigns.h"

#include <omnimapper/graph/VariableKinds.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "SignPayload.h"

namespace omnimapper::plugins {

graph::FactorRecord ofLandmark(graph::FactorRecord record, base::LandmarkId landmark, const std::string& section) {
  record.tags.owner = section;
  record.tags.landmark = landmark;
  return record;
}

void addSign(const std::vector<SignView>& views, const Triangulation& place, mapper::PanTiltOffsets& offsets,
             const SignLandmarksOptions& options, const std::string& section, mapper::Batch& batch) {
  auto payload = std::make_shared<SignPayload>();
  bool has_range = false;
  for (const auto i : place.views) {
    const auto& seen = views[i].measurement;
    payload = payload->with(seen.text, views[i].label);
    if (payload->isBetter(seen.area_px)) payload->best_look = seen.look(views[i].frame);
    has_range = has_range || seen.range;
  }
  const auto variable = batch.addVariable(graph::point3(), place.point);
  const auto seen_at = [&](std::size_t i) { return views[place.views[i]].stamp; };
  const auto landmark = batch.addLandmark("sign", {variable}, payload, seen_at(0));
  for (std::size_t i = 1; i < place.views.size(); ++i) batch.addEvidence(landmark, nullptr, seen_at(i));
  for (const auto i : place.views) {
    const auto& [frame, stamp, pose, label, seen, travelled] = views[i];
    const auto offset_variable = offsets.find(label, batch);
    batch.addFactor(ofLandmark(seen.directionRecord(pose, variable, offset_variable, options), landmark, section));
    if (auto range = seen.rangeRecord(pose, variable))
      batch.addFactor(ofLandmark(std::move(*range), landmark, section));
  }
  if (has_range) return;
  const auto& last = views[place.views.back()];
  batch.addFactor(ofLandmark(last.measurement.legibilityRecord(last.pose, variable), landmark, section));
}

namespace {

struct SignPlace {
  SignText text;
  Eigen::Vector3d point;
};

bool isAmong(const std::vector<SignPlace>& places, const SignText& text, const Eigen::Vector3d& point) {
  constexpr double kOfOneSign = 1;  // [m]
  return std::any_of(places.begin(), places.end(), [&](const SignPlace& place) {
    const bool is_alike = agreementOf(text, place.text) == Agreement::agrees || mayBeMisread(text, place.text);
    return is_alike && (place.point - point).norm() < kOfOneSign;
  });
}

}  // namespace

void addUnplacedSigns(const SignTracks& tracks, mapper::PanTiltOffsets& offsets, const SignLandmarksOptions& options,
                      const std::string& section, const mapper::View& view, mapper::Batch& batch) {
  constexpr std::size_t kMinViews = 3;
  std::vector<SignPlace> there;
  for (const auto& [id, known] : tracks.all())
    there.push_back({signOf(view, id).text(), view.graph.value(known.variable)});
  for (auto views : tracks.unplacedViews(options.recent_travel)) {
    // triangulate() requires the last view to meet the others. If it does not, the one before it is tried as the last.
    while (views.size() >= kMinViews) {
      const auto offset_variable = offsets.find(views.back().label, batch);
      const KnownOffsets known{mapper::PanTiltOffsets::estimate(offset_variable, view.graph), 0};
      const auto place = triangulate(views, view.graph, known, options.max_sigma, kMinViews);
      if (!place) {
        views.pop_back();
        continue;
      }
      const SignText text = views.back().measurement.text;
      if (!isAmong(there, text, place->point)) {
        there.push_back({text, place->point});
        addSign(views, *place, offsets, options, section, batch);
      }
      for (auto i = place->views.rbegin(); i != place->views.rend(); ++i)
        views.erase(views.begin() + static_cast<std::ptrdiff_t>(*i));
    }
  }
}

}  // namespace omnimapper::plugins
