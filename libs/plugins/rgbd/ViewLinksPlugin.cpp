#include "ViewLinksPlugin.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "CloudOdometryPlugin.h"
#include "VisualOdometryPlugin.h"
#include "returnEvidence.h"

namespace omnimapper::plugins {

namespace {

// viewDistance() within which a view is certainly visible again.
constexpr double kSurelySeen = 1.5;

double percentOf(std::size_t part, std::size_t all) {
  return all > 0 ? 100 * static_cast<double>(part) / static_cast<double>(all) : 0;
}

}  // namespace

using geometry::Se3;
using mrpt::obs::CObservation3DRangeScan;

const base::OptionTable<ViewLinksOptions>& ViewLinksOptions::table() {
  using Options = ViewLinksOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("odometry", &Options::odometry,
                "INI section of the camera odometry plugin. Its label, its settings for matching, and its readout "
                "times and picture delay are used here, too.")
          .integer("key_frames_back", &Options::key_frames_back, base::Range{0, 20},
                   "How many key frames back a key frame is linked. With 3, it is linked to the second and the third "
                   "before it; odometry links it to the first.")
          .integer("old_views", &Options::old_views, base::Range{0, 20},
                   "Largest number of older key frames to which a key frame is linked if the camera sees again what "
                   "they show.")
          .integer("stored_views", &Options::stored_views, base::Range{1, 100000},
                   "Largest number of older key frames whose images are stored; beyond it the oldest images are "
                   "dropped. A thousand images take 250 MB at most.")
          .number("overlap", &Options::overlap, base::Range{0.1, 1},
                  "A key frame is linked to an older one only if its image shows at least this share of what the older "
                  "one's image shows.")
          .number("loss_scale", &Options::loss_scale, base::Range::positive(),
                  "Number of standard deviations beyond which a link that disagrees loses influence (scale of the "
                  "Cauchy loss).");
  return table;
}

namespace {
ViewLinksPlugin::Camera cameraOf(const std::string& odometry, const mapper::PluginContext& context) {
  const std::string place = "[" + context.section + "] odometry: ";
  const auto ini = base::Config::fromText(context.config_text, "the INI");
  if (!ini.has(odometry) && odometry != ViewLinksOptions{}.odometry)
    throw base::Error(base::ExitCode::unknown_key, place + "there is no section [" + odometry + "] in the INI");
  const auto section = ini.section(odometry);
  std::string class_name = VisualOdometryPlugin::kName;
  section.find("class", class_name);
  if (class_name == CloudOdometryPlugin::kName) {  // which has no shutters
    ViewLinksPlugin::Camera camera;
    section.find("label", camera.label);
    return camera;
  }
  if (class_name != VisualOdometryPlugin::kName) {
    throw base::Error(base::ExitCode::out_of_range, place + "[" + odometry + "] is a " + class_name +
                                                        "; it must be a VisualOdometryPlugin or a CloudOdometryPlugin");
  }
  return {VisualOdometrySection::read<CameraOdometryOptions>(section).label,
          VisualOdometrySection::read<matching::RgbdTrackerOptions>(section),
          VisualOdometrySection::read<matching::DenseMatcherOptions>(section)};
}
}  // namespace

ViewLinksPlugin::ViewLinksPlugin(const ViewLinksOptions& options, const mapper::PluginContext& context)
    : ViewLinksPlugin(options, cameraOf(options.odometry, context), context) {}

ViewLinksPlugin::ViewLinksPlugin(const ViewLinksOptions& options, const Camera& camera,
                                 const mapper::PluginContext& context)
    : options_(options), camera_(camera), matcher_(camera.matching), context_(context) {}

bool ViewLinksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
  return scan && scan->hasRangeImage && (camera_.label.empty() || scan->sensorLabel == camera_.label);
}

std::unique_ptr<const mapper::Prepared> ViewLinksPlugin::prepareUsing(const mrpt::obs::CObservation& observation,
                                                                      const perception::Blackboard& board) const {
  const auto& scan = dynamic_cast<const CObservation3DRangeScan&>(observation);
  auto seen = std::make_unique<SeenImage>();
  seen->image = board.find<StraightImage>();
  try {
    // The observation outlives what is prepared of it.
    const CObservation3DRangeScan::ConstPtr borrowed(CObservation3DRangeScan::ConstPtr{}, &scan);
    if (!seen->image) seen->image = std::make_shared<const StraightImage>(borrowed, lens_);
    const auto depth = seen->image->pyramid().medianDepth();
    if (!depth) return nullptr;
    seen->base_from_camera = geometry::fromMrpt(scan.sensorPose) * geometry::sensorFromOptical();
    seen->depth = *depth;
  } catch (const base::Error&) {  // the odometry warns of images that cannot be read
    return nullptr;
  }
  return seen;
}

mapper::Batch ViewLinksPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                       const mapper::View& view) {
  const std::string& label = observed.observation.sensorLabel;
  if (label_.empty()) label_ = label;
  const auto* seen = dynamic_cast<const SeenImage*>(observed.prepared);
  if (label != label_ || seen == nullptr) return {};
  return linksOf(frame, *seen, view);
}

mapper::Batch ViewLinksPlugin::linksOf(const map::KeyFrame& frame, const SeenImage& seen, const mapper::View& view) {
  const matching::RgbdPyramid& pyramid = seen.image->pyramid();
  const Se3& base_from_camera = seen.base_from_camera;
  const auto motion = motionAt(frame, base_from_camera, view);
  KeyImage image{frame.id, matcher_.prepare(pyramid, motion), base_from_camera, seen.depth, motion.velocity};
  std::vector<Link> links;
  // Compares positions in the trajectory, because a late image may have inserted a key frame between others.
  const std::size_t position = view.map.key_frames.position(frame.id);
  for (auto earlier = recent_.rbegin(); earlier != recent_.rend(); ++earlier) {
    const std::size_t other = view.map.key_frames.position(earlier->frame);
    const bool is_near =
        other + 2 <= position && position <= other + static_cast<std::size_t>(options_.key_frames_back);
    if (!is_near || earlier->frame.session != frame.id.session) continue;
    if (auto link = linkTo(*earlier, image, pyramid, motion, view)) links.push_back(std::move(*link));
  }
  for (const KeyImage* old : viewsSeenAgain(image, view)) {
    auto link = linkTo(*old, image, pyramid, motion, view);
    const bool was_left = wasLeft(*old, frame, view);
    if (was_left && viewDistance(*old, image, view) < kSurelySeen) {
      ++expected_;
      missed_ += !link;
    }
    if (!link || link->match.overlap < options_.overlap) continue;
    link->is_old = true;
    link->is_return = was_left;
    if (was_left) {
      returns_.push_back({old->frame, frame.id, link->match.reference_from_image, old->base_from_camera,
                          base_from_camera, old->depth});
    }
    links.push_back(std::move(*link));
  }
  mapper::Batch batch;
  for (const Link& link : links) {
    auto factor = mapper::betweenPoses(context_.motion, view.map.keyFrame(link.to->frame).pose, frame.pose,
                                       motionOf(link, image, links.size()), context_.section);
    factor.loss = graph::Loss::cauchy(options_.loss_scale);
    if (!link.is_old) {
      batch.addFactor(std::move(factor));
      continue;
    }
    mapper::Decision decision(frame, context_.section, "view seen again");
    decision.to = link.to->frame;
    decision.accepted = true;
    decision.reason = "the images fit";
    decision.numbers = {{"overlap", link.match.overlap}, {"outlier_share", link.match.outlier_share}};
    decision.is_loop_closure = link.is_return;
    batch.addHypothesis(std::move(factor), std::move(decision));
  }
  remember(std::move(image), view);
  return batch;
}

Se3 ViewLinksPlugin::between(const KeyImage& from, const KeyImage& to, const mapper::State& state) const {
  const Se3 map_from = geometry::fromMrpt(state.map.keyFrame(from.frame).map_from_base) * from.base_from_camera;
  const Se3 map_to = geometry::fromMrpt(state.map.keyFrame(to.frame).map_from_base) * to.base_from_camera;
  return inverse(map_from) * map_to;
}

double ViewLinksPlugin::viewDistance(const KeyImage& from, const KeyImage& to, const mapper::State& state) const {
  return viewDistance(between(from, to, state), from.depth);
}

double ViewLinksPlugin::viewDistance(const Se3& motion, double depth) const {
  return std::max(geometry::logSo3(motion.rotation).norm() / camera_.tracking.key_angle,
                  motion.translation.norm() / (camera_.tracking.key_distance * depth));
}

std::optional<ViewLinksPlugin::Link> ViewLinksPlugin::linkTo(const KeyImage& to, const KeyImage& image,
                                                             const matching::RgbdPyramid& pyramid,
                                                             const matching::CameraMotion& motion,
                                                             const mapper::State& state) const {
  constexpr double kOutlierShare = 0.1;
  auto match = matcher_.match(*to.reference, pyramid, {between(to, image, state)}, motion);
  if (!match.succeeded || match.outlier_share > kOutlierShare) return std::nullopt;
  return Link{&to, std::move(match)};
}

// Whether the camera was elsewhere between a view and `frame`, so that its return reveals drift.
bool ViewLinksPlugin::wasLeft(const KeyImage& old, const map::KeyFrame& frame, const mapper::State& state) const {
  constexpr double kLeft = 8;
  const auto& frames = state.map.key_frames;
  const Se3 camera_from_map =
      inverse(geometry::fromMrpt(state.map.keyFrame(old.frame).map_from_base) * old.base_from_camera);
  const std::size_t end = frames.position(frame.id);
  for (std::size_t i = frames.position(old.frame); i < end; ++i) {
    const Se3 motion = camera_from_map * geometry::fromMrpt(frames[i].map_from_base) * old.base_from_camera;
    if (viewDistance(motion, old.depth) > kLeft) return true;
  }
  return false;
}

// The nearest older views, by the estimate.
std::vector<const ViewLinksPlugin::KeyImage*> ViewLinksPlugin::viewsSeenAgain(const KeyImage& image,
                                                                              const mapper::State& state) const {
  constexpr double kFarthest = 4;
  std::vector<std::pair<double, const KeyImage*>> near;
  for (const KeyImage& old : views_) {
    const double far = viewDistance(old, image, state);
    if (far < kFarthest) near.emplace_back(far, &old);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  near.resize(std::min(near.size(), static_cast<std::size_t>(options_.old_views)));
  std::vector<const KeyImage*> nearest;
  for (const auto& one : near) nearest.push_back(one.second);
  return nearest;
}

mapper::RelativeMotion ViewLinksPlugin::motionOf(const Link& link, const KeyImage& image, std::size_t links) const {
  // Neighbouring residuals share errors: kAlike of them count as one. A shutter's readout time is known to a fifth.
  constexpr double kAlike = 30, kReadoutError = 0.2;
  const double readout_sigma =
      kReadoutError * std::max(std::abs(camera_.tracking.depth_readout), std::abs(camera_.tracking.picture_readout));
  const geometry::Vector6d of_image = readout_sigma * image.velocity;
  const geometry::Vector6d of_other =
      readout_sigma * (adjoint(inverse(link.match.reference_from_image)) * link.to->velocity);
  geometry::Matrix6d of_camera =
      kAlike * link.match.covariance + of_image * of_image.transpose() + of_other * of_other.transpose();
  of_camera *= static_cast<double>(links);
  const geometry::Matrix6d ad = adjoint(image.base_from_camera);
  return {
      geometry::toMrpt(link.to->base_from_camera * link.match.reference_from_image * inverse(image.base_from_camera)),
      ad * of_camera * ad.transpose()};
}

// The velocity since the image or key frame before, to correct for the shutters.
matching::CameraMotion ViewLinksPlugin::motionAt(const map::KeyFrame& frame, const Se3& base_from_camera,
                                                 const mapper::State& state) const {
  matching::CameraMotion motion{geometry::Vector6d::Zero(), camera_.tracking.depth_readout,
                                camera_.tracking.picture_delay, camera_.tracking.picture_readout,
                                camera_.tracking.picture_delay_sigma};
  const std::size_t position = state.map.key_frames.position(frame.id);
  if (position == 0) return motion;
  const map::KeyFrame& before = state.map.key_frames[position - 1];
  const bool has_dependents = !before.dependents.empty();
  const Se3 before_from_last = has_dependents ? geometry::fromMrpt(before.dependents.back().keyframe_from_base) : Se3{};
  const double seconds =
      base::secondsBetween(has_dependents ? before.dependents.back().stamp : before.stamp, frame.stamp);
  constexpr double kShortest = 0.01, kLongest = 0.5;  // [s]
  if (before.id.session != frame.id.session || seconds < kShortest || seconds > kLongest) return motion;
  const Se3 last_from_base = inverse(before_from_last) * geometry::fromMrpt(before.keyframe_from_next);
  motion.velocity = minus(inverse(base_from_camera) * last_from_base * base_from_camera, Se3{}) / seconds;
  return motion;
}

// An image that is no longer recent becomes an older view if none of these is near it.
void ViewLinksPlugin::remember(KeyImage seen, const mapper::State& state) {
  constexpr std::size_t kRecent = 10;  // key frames
  constexpr double kApart = 0.5;
  recent_.push_back(std::move(seen));
  if (recent_.size() <= std::max(kRecent, static_cast<std::size_t>(options_.key_frames_back))) return;
  KeyImage old = std::move(recent_.front());
  recent_.erase(recent_.begin());
  const bool is_known = std::any_of(views_.begin(), views_.end(),
                                    [&](const KeyImage& view) { return viewDistance(view, old, state) < kApart; });
  if (is_known) return;
  views_.push_back(std::move(old));
  if (views_.size() > static_cast<std::size_t>(options_.stored_views)) views_.erase(views_.begin());
}

void ViewLinksPlugin::retired(const map::KeyFrame& frame) {
  for (auto* list : {&recent_, &views_}) {
    list->erase(
        std::remove_if(list->begin(), list->end(), [&](const KeyImage& seen) { return seen.frame == frame.id; }),
        list->end());
  }
}

std::vector<mapper::Evidence> ViewLinksPlugin::evidence(const mapper::View& view) const {
  if (label_.empty() || options_.old_views == 0 || view.map.key_frames.empty()) return {};
  // The images of earlier sessions are not known.
  const auto& last = view.map.key_frames.back();
  const auto& first = *std::find_if(view.map.key_frames.begin(), view.map.key_frames.end(),
                                    [&](const map::KeyFrame& frame) { return frame.id.session == last.id.session; });
  std::vector<Loop> loops;
  for (const Return& one : returns_) {
    if (isElsewhere(one, view)) continue;
    loops.emplace_back(view.map.keyFrame(one.before).stamp, view.map.keyFrame(one.frame).stamp);
  }
  const std::size_t elsewhere = returns_.size() - loops.size();
  auto evidence = returnEvidence(std::move(loops), first.stamp, last.stamp);
  evidence.push_back(elsewhereEvidence(elsewhere, returns_.size()));
  evidence.push_back(missedEvidence());
  return evidence;
}

// Whether the pose of the camera in the map differs so much from that measured by its image that a point at the median
// depth is some pixels off.
bool ViewLinksPlugin::isElsewhere(const Return& one, const mapper::State& state) const {
  constexpr double kFar = 0.5;
  const Se3 map_from_before =
      geometry::fromMrpt(state.map.keyFrame(one.before).map_from_base) * one.before_base_from_camera;
  const Se3 map_from_camera = geometry::fromMrpt(state.map.keyFrame(one.frame).map_from_base) * one.base_from_camera;
  return viewDistance(inverse(one.before_from_camera) * inverse(map_from_before) * map_from_camera, one.depth) > kFar;
}

mapper::Evidence ViewLinksPlugin::elsewhereEvidence(std::size_t elsewhere, std::size_t all) {
  using Says = mapper::Evidence::Says;
  constexpr double kMany = 15;  // [%]
  const double percent = percentOf(elsewhere, all);
  const bool is_many = percent > kMany;
  char text[200];
  std::snprintf(text, sizeof text, "of %zu returns to earlier views %zu lie elsewhere in the map than by their images",
                all, elsewhere);
  return {"camera_returns_elsewhere_percent", percent, is_many ? Says::too_little : Says::good, is_many ? text : ""};
}

mapper::Evidence ViewLinksPlugin::missedEvidence() const {
  using Says = mapper::Evidence::Says;
  constexpr double kMany = 10;      // [%]
  constexpr std::size_t kFew = 10;  // fewer are not judged
  const double percent = percentOf(missed_, expected_);
  const bool is_distorted = percent > kMany && expected_ >= kFew;
  char text[200];
  std::snprintf(text, sizeof text,
                "of the %zu times that the map has the camera back at an earlier view, the image showed something "
                "else %zu times: the map is distorted",
                expected_, missed_);
  return {"camera_returns_missed_percent", percent, is_distorted ? Says::against_it : Says::good,
          is_distorted ? text : ""};
}

}  // namespace omnimapper::plugins
