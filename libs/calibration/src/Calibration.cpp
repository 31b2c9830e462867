#include "Calibration.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "CornerAlignment.h"
#include "Determined.h"

namespace omnimapper::calibration {

namespace {

constexpr std::size_t kHoldEvery = 5, kFewestViews = 10, kFewestTracks = 150, kFewestInTrack = 3, kMostTracks = 3000;
constexpr std::size_t kFewestSpans = 5, kFewestCorners = 600;
// [px s/rad] Additional standard deviation of a corner while the camera turns, because its rotation during the readout
// of the rows is not known exactly. In freiburg1_rpy the calibrated rays are 1.4 px off without it, and 0.6 px with it.
constexpr double kOfTurning = 2;

bool isHeldBack(std::size_t view) {
  return view % kHoldEvery == kHoldEvery / 2;
}

std::vector<Measurement> measurementsOf(const std::vector<Track>& tracks, const std::vector<CalibrationView>& views,
                                        bool held_back) {
  std::vector<Measurement> all;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const auto& of_track = tracks[t].measurements;
    const auto used =
        std::count_if(of_track.begin(), of_track.end(), [](const CornerMeasurement& s) { return !isHeldBack(s.view); });
    if (used < 2) continue;
    for (const auto& measurement : of_track) {
      if (isHeldBack(measurement.view) != held_back) continue;
      const auto& view = views[measurement.view];
      all.push_back({t,
                     measurement.view,
                     measurement.pixel,
                     std::hypot(measurement.sigma, kOfTurning * view.turn_rate),
                     {},
                     measurement.pixel.y() / view.height - 0.5,
                     0,
                     view.velocity});
    }
  }
  return all;
}

// Marks the first view of each stretch that has measurements.
std::vector<bool> firstViews(const std::vector<CalibrationView>& views, const std::vector<Measurement>& measurements) {
  std::vector<bool> is_seen(views.size(), false), first(views.size(), false);
  for (const auto& one : measurements) is_seen[one.view] = true;
  int stretch = -1;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!is_seen[i] || views[i].stretch == stretch) continue;
    stretch = views[i].stretch;
    first[i] = true;
  }
  return first;
}

void refuseTooLittle(std::size_t views, std::size_t tracks) {
  const std::string remedy =
      "; record half a minute in which the camera turns and moves slowly in front of objects with corners, near and "
      "far";
  if (views < kFewestViews)
    throw base::Error(base::ExitCode::nothing_to_map,
                      "the camera moved too little to be calibrated: " + base::counted(views, "different view") +
                          " of " + std::to_string(kFewestViews) + " that are needed" + remedy);
  if (tracks < kFewestTracks)
    throw base::Error(base::ExitCode::nothing_to_map, "too few corners were found in " +
                                                          std::to_string(kFewestInTrack) +
                                                          " views: " + std::to_string(tracks) + " of " +
                                                          std::to_string(kFewestTracks) + " that are needed" + remedy);
}

void refuseTooFew(std::size_t corners) {
  if (corners >= kFewestCorners) return;
  throw base::Error(base::ExitCode::nothing_to_map,
                    "only " + std::to_string(corners) + " corners are consistent with one another, of " +
                        std::to_string(kFewestCorners) +
                        " that are needed; record half a minute in which the camera turns and moves slowly in front of "
                        "objects with corners, near and far, at 10 images in a second or more");
}

double trimmedRms(std::vector<double> squares) {
  if (squares.empty()) return 0;
  std::sort(squares.begin(), squares.end());
  const std::size_t kept = std::max<std::size_t>(1, squares.size() * 9 / 10);
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += squares[i];
  return std::sqrt(sum / static_cast<double>(kept));
}

// Expected pose of a held-back view: that of the nearest view of the estimate, plus the tracked motion between them.
geometry::Se3 expectedPose(const BundleInput& used, const Estimate& estimate, const std::vector<bool>& has_part,
                           std::size_t view) {
  const auto& views = used.views;
  for (std::size_t step = 1; step < views.size(); ++step) {
    for (const std::size_t near : {view - step, view + step}) {
      if (near >= views.size() || !has_part[near] || views[near].stretch != views[view].stretch) continue;
      return inverse(views[view].world_from_picture) * views[near].world_from_picture *
             estimate.picture_from_world[near];
    }
  }
  return estimate.picture_from_world[view];
}

// Tests on the points that at least three views of the estimate measure.
HeldBack testOn(const std::vector<Measurement>& held, const BundleInput& used, const Estimate& estimate) {
  std::vector<int> counts(estimate.points.size(), 0);
  std::vector<bool> has_part(used.views.size(), false);
  for (const auto& one : used.measurements) {
    ++counts[one.track];
    has_part[one.view] = true;
  }
  std::map<std::size_t, std::vector<Measurement>> by_view;
  for (const auto& one : held)
    if (counts[one.track] >= 3) by_view[one.view].push_back(one);
  HeldBack result;
  std::vector<double> pixel_squares, depth_squares;
  double cost = 0;
  constexpr std::size_t kFewest = 15;
  for (const auto& [view, of_view] : by_view) {
    if (of_view.size() < kFewest) continue;
    const auto fitted = fitView(of_view, used.views[view], estimate, expectedPose(used, estimate, has_part, view));
    result.pixels.insert(result.pixels.end(), fitted.pixels.begin(), fitted.pixels.end());
    result.misses.insert(result.misses.end(), fitted.misses.begin(), fitted.misses.end());
    for (const auto& miss : fitted.misses) pixel_squares.push_back(miss.squaredNorm());
    for (const double miss : fitted.depth_misses) depth_squares.push_back(miss * miss);
    cost += fitted.cost;
  }
  result.corners = pixel_squares.size();
  if (result.corners == 0) return result;
  result.cost = cost / static_cast<double>(2 * pixel_squares.size() + depth_squares.size());
  result.pixel_rms = trimmedRms(pixel_squares);
  result.depth_rms = trimmedRms(depth_squares);
  std::nth_element(pixel_squares.begin(), pixel_squares.begin() + pixel_squares.size() / 2, pixel_squares.end());
  result.pixel_median = std::sqrt(pixel_squares[pixel_squares.size() / 2]);
  return result;
}

// Whether the scale of the depths does not differ significantly from the log's.
bool isScaleOfLog(const Adjusted& adjusted, const DepthCamera& log) {
  const auto is_scale = [](const Parameter& one) { return one.group == Group::scale; };
  const auto scale = std::find_if(adjusted.parameters.begin(), adjusted.parameters.end(), is_scale);
  return scale == adjusted.parameters.end() || std::abs(scale->value - log.depth_scale) < 2 * scale->sigma;
}

// Frees all groups, then drops the one that the log determines worst, until all free groups are determined.
Adjusted adjustWhatIsDetermined(const BundleInput& input, const Estimate& start, std::set<Group> free,
                                std::map<Group, Adjusted>& attempts) {
  Estimate from = start;
  while (true) {
    auto adjusted = adjust(input, from, free);
    double worst = 1;
    std::optional<Group> let_go;
    for (const Group group : free) {
      double one = undetermined(group, adjusted);
      if (group == Group::scale && one <= 1 && isScaleOfLog(adjusted, input.log)) one = 1.001;
      if (one <= worst) continue;
      worst = one;
      let_go = group;
    }
    if (!let_go) return adjusted;
    free.erase(*let_go);
    attempts[*let_go] = adjusted;
    from = adjusted.estimate;
    const auto& log = input.log;
    auto& camera = from.camera;
    const auto restore = [&](Intrinsics& to, const Intrinsics& of_log, std::size_t begin, std::size_t end) {
      std::copy(of_log.begin() + begin, of_log.begin() + end, to.begin() + begin);
    };
    switch (*let_go) {
      case Group::focal:
        restore(camera.picture, log.picture, 0, 2);
        break;
      case Group::centre:
        restore(camera.picture, log.picture, 2, 4);
        break;
      case Group::lens:
        restore(camera.picture, log.picture, 4, 9);
        break;
      case Group::depth_focal:
        restore(camera.depth, log.depth, 0, 2);
        break;
      case Group::depth_centre:
        restore(camera.depth, log.depth, 2, 4);
        break;
      case Group::place:
        camera.depth_from_picture.translation = log.depth_from_picture.translation;
        break;
      case Group::turn:
        camera.depth_from_picture.rotation = log.depth_from_picture.rotation;
        break;
      case Group::scale:
        camera.depth_scale = log.depth_scale;
        break;
      case Group::timing:
        break;
    }
  }
}

std::set<Group> allGroups(const DepthCamera& camera, bool has_metres) {
  std::set<Group> all{Group::focal, Group::centre, Group::lens, Group::timing};
  if (!camera.is_registered) all.insert({Group::depth_focal, Group::depth_centre, Group::place, Group::turn});
  if (has_metres) all.insert(Group::scale);
  return all;
}

}  // namespace

Calibration calibrate(const std::vector<CalibrationView>& views, const DepthCamera& log,
                      const std::vector<MetricSpan>& spans, base::Progress& progress,
                      const std::function<bool()>& stop) {
  if (views.size() < kFewestViews) refuseTooLittle(views.size(), 0);
  progress.report(0.8, "matching corners");
  auto tracks = findTracks(views, log, kFewestInTrack, kMostTracks);
  alignCorners(tracks, views, log, kFewestInTrack);
  refuseTooLittle(views.size(), tracks.size());
  Estimate start{log, {}, {}, {}};
  for (const auto& view : views) start.picture_from_world.push_back(inverse(view.world_from_picture));
  for (const auto& track : tracks) start.points.push_back(track.point);

  BundleInput input{views, measurementsOf(tracks, views, false), {}, log, {}, stop};
  input.are_held = firstViews(views, input.measurements);
  for (const auto& span : spans)
    if (!isHeldBack(span.first) && !isHeldBack(span.second)) input.spans.push_back(span);
  const bool has_metres = input.spans.size() >= kFewestSpans;
  const auto groups = allGroups(log, has_metres);

  // The gates are wide while the camera is the log's, and narrower when it fits better.
  associateSurfaces(input, start);
  auto adjusted = adjust(input, start, {Group::timing});
  leaveOutContradictions(input, adjusted.estimate, 20, 10);
  for (const double gate : {8.0, 5.0}) {
    progress.report(gate > 6 ? 0.85 : 0.9, "adjusting");
    associateSurfaces(input, adjusted.estimate);
    adjusted = adjust(input, adjusted.estimate, groups);
    leaveOutContradictions(input, adjusted.estimate, gate, gate);
  }
  refuseTooFew(input.measurements.size());
  associateSurfaces(input, adjusted.estimate);
  std::map<Group, Adjusted> attempts;
  adjusted = adjustWhatIsDetermined(input, adjusted.estimate, groups, attempts);

  // The pose error of registered depths is estimated for the report. It is not written: with it, mapping would lose the
  // picture at the edges of the depths.
  if (log.is_registered) {
    auto with_place = groups;
    with_place.insert({Group::place, Group::turn});
    attempts[Group::place] = attempts[Group::turn] = adjust(input, adjusted.estimate, with_place);
  }

  progress.report(0.95, "testing on held-back views");
  Calibration result;
  result.log = log;
  result.estimate = adjusted.estimate.camera;
  result.groups = resultsOf(log, adjusted, attempts, has_metres);
  const auto held = measurementsOf(tracks, views, true);
  result.after = testOn(held, input, adjusted.estimate);
  for (int round = 0; round < 2; ++round) {
    associateSurfaces(input, start);
    start = adjust(input, start, {Group::timing}).estimate;
  }
  result.before = testOn(held, input, start);
  constexpr double kBetter = 0.99;
  result.is_better = result.after.corners > 0 && result.after.cost < kBetter * result.before.cost;
  result.views = views.size();
  for (std::size_t i = 0; i < views.size(); ++i) result.held_views += isHeldBack(i);
  result.tracks = tracks.size();
  result.corners = input.measurements.size();
  result.surfaces = static_cast<std::size_t>(std::count_if(input.measurements.begin(), input.measurements.end(),
                                                           [](const Measurement& m) { return m.plane.has_value(); }));
  result.spans = has_metres ? input.spans.size() : 0;
  return result;
}

}  // namespace omnimapper::calibration
