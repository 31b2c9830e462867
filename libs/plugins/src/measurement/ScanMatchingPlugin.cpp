#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose2D.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/mapper/PoseFactors.h>
#include <omnimapper/plugins/ScanMatchingPlugin.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

IMPLEMENTS_MRPT_OBJECT(ScanMatchingPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

namespace {

using mrpt::math::TPose2D;

constexpr const char* kCloudSuffix = ".points";

TPose2D planar(const mrpt::poses::CPose3D& pose) {
  return {pose.x(), pose.y(), pose.yaw()};
}

// The cloud in the plane of the base.
matching::PlanarScan scanInBase(const mrpt::obs::CObservationPointCloud& cloud) {
  std::vector<Eigen::Vector2f> points;
  points.reserve(cloud.pointcloud->size());
  for (std::size_t i = 0; i < cloud.pointcloud->size(); ++i) {
    float x, y, z;
    cloud.pointcloud->getPointFast(i, x, y, z);
    double bx, by, bz;
    cloud.sensorPose.composePoint(x, y, z, bx, by, bz);
    if (std::isfinite(bx) && std::isfinite(by)) points.emplace_back(bx, by);
  }
  return matching::fitLines(points);
}

}  // namespace

const base::OptionTable<ScanMatchingOptions>& ScanMatchingOptions::table() {
  using Options = ScanMatchingOptions;
  static const auto table =
      base::OptionTable<Options>()
          .list("labels", &Options::labels, "Labels of the clouds to match; empty for all made from 2D scans.")
          .integer("local_frames", &Options::local_frames, base::Range{1, 1000},
                   "A scan is matched against the scans of so many key frames before it.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "Share of the points that must find a partner.")
          .number("max_correction_m", &Options::max_correction, base::Range::positive(),
                  "A match farther from the prediction is refused.")
          .number("max_turn_correction_deg", &Options::max_turn_correction, base::Range{0, 180},
                  "A match turned farther from the prediction is refused.")
          .number("point_sigma_m", &Options::point_sigma, base::Range::positive(),
                  "Standard deviation of a point from the wall it lies on.")
          .number("wall_sigma_factor", &Options::wall_sigma_factor, base::Range::notNegative(),
                  "The same as a multiple of the distance that the points of a match have from the walls; the larger "
                  "counts.")
          .number("position_sigma_floor_m", &Options::position_sigma_floor, base::Range::positive(),
                  "No match is trusted more than this.")
          .number("angle_sigma_floor_deg", &Options::angle_sigma_floor, base::Range::positive(),
                  "No match is trusted more than this.")
          .flag("close_loops", &Options::close_loops, "Match against places seen long ago.")
          .number("loop_radius_m", &Options::loop_radius, base::Range::positive(),
                  "Places whose estimate is within this distance are tried.")
          .number("loop_min_way_m", &Options::loop_min_way, base::Range::positive(),
                  "Places left less than this way ago are no loop.")
          .integer("loop_frames", &Options::loop_frames, base::Range{0, 1000},
                   "Key frames before and after a place that make its local map.")
          .integer("loop_candidates", &Options::loop_candidates, base::Range{1, 1000}, "Places tried per key frame.")
          .number("loop_min_overlap", &Options::loop_min_overlap, base::Range{0, 1},
                  "Share of the points that must find a partner.")
          .number("loop_max_distance_m", &Options::loop_max_distance, base::Range::positive(),
                  "Largest distance of paired points at the start.")
          .number("loop_max_correction_m", &Options::loop_max_correction, base::Range::positive(),
                  "A closure farther from the prediction is refused.")
          .number("loop_max_turn_correction_deg", &Options::loop_max_turn_correction, base::Range{0, 180},
                  "A closure turned farther from the prediction is refused.")
          .number("loop_max_chi2", &Options::loop_max_chi2, base::Range::positive(),
                  "A closure that contradicts the trajectory more than this is refused: chi-square of 3 degrees of "
                  "freedom. 16.3 would pass 99.9 % if matches in sequence erred independently; they share their local "
                  "map, and twice the sigma is allowed for.")
          .number("loop_loss_scale", &Options::loop_loss_scale, base::Range::positive(),
                  "Scale of the Cauchy loss on closures, in standard deviations.");
  return table;
}

ScanMatchingPlugin::ScanMatchingPlugin(const ScanMatchingOptions& options, const matching::IcpOptions& icp,
                                       const mapper::PluginContext& context)
    : options_(options), context_(context), sequential_matcher_(icp), loop_matcher_([&] {
        auto wide = icp;
        wide.max_distance = options.loop_max_distance;
        return wide;
      }()) {}

bool ScanMatchingPlugin::wants(const mrpt::obs::CObservation& observation) const {
  if (!dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation)) return false;
  const std::string& label = observation.sensorLabel;
  if (!options_.labels.empty()) {
    return std::find(options_.labels.begin(), options_.labels.end(), label) != options_.labels.end();
  }
  const std::string suffix = kCloudSuffix;
  return label.size() >= suffix.size() && label.compare(label.size() - suffix.size(), suffix.size(), suffix) == 0;
}

mapper::Batch ScanMatchingPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                          const mapper::View& view) {
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(observed.observation);
  History& history = histories_[cloud.sensorLabel];
  double way = 0;
  if (!history.empty()) {
    const auto& before = view.map.keyFrame(history.back().id).map_from_base;
    way = history.back().way + (frame.map_from_base - before).translation().norm();
  }
  history.push_back({frame.id, scanInBase(cloud), way});
  mapper::Batch batch;
  if (history.size() < 2 || history.back().scan_in_base.empty()) return batch;
  matchSequential(frame, history, view, batch);
  if (options_.close_loops) closeLoops(frame, history, view, batch);
  return batch;
}

void ScanMatchingPlugin::matchSequential(const map::KeyFrame& frame, const History& history, const mapper::View& view,
                                         mapper::Batch& batch) const {
  const std::size_t previous = history.size() - 2;
  const auto frames = static_cast<std::size_t>(options_.local_frames);
  const std::size_t first = previous + 1 > frames ? previous + 1 - frames : 0;
  const auto reference = localMap(history, first, previous, previous, view);
  const auto& before = view.map.keyFrame(history[previous].id);
  const TPose2D guess = planar(frame.map_from_base - before.map_from_base);
  const auto match = sequential_matcher_.match(reference, history.back().scan_in_base, guess);

  auto decision = judge(match, guess, {options_.min_overlap, options_.max_correction, options_.max_turn_correction});
  decision.stamp = frame.stamp;
  decision.kind = "sequential match";
  decision.from = frame.id;
  decision.to = before.id;
  if (decision.accepted) batch.addFactor(factor(before.pose, frame.pose, match));
  batch.log(std::move(decision));
}

void ScanMatchingPlugin::closeLoops(const map::KeyFrame& frame, const History& history, const mapper::View& view,
                                    mapper::Batch& batch) {
  const auto around = static_cast<std::size_t>(options_.loop_frames);
  for (const std::size_t candidate : loopCandidates(frame, history, view)) {
    const std::size_t first = candidate > around ? candidate - around : 0;
    const std::size_t last = std::min(candidate + around, history.size() - 2);
    const auto reference = localMap(history, first, last, candidate, view);
    const auto& place = view.map.keyFrame(history[candidate].id);
    const TPose2D guess = planar(frame.map_from_base - place.map_from_base);
    const auto match = loop_matcher_.match(reference, history.back().scan_in_base, guess);

    auto decision = judge(match, guess,
                          {options_.loop_min_overlap, options_.loop_max_correction, options_.loop_max_turn_correction});
    decision.stamp = frame.stamp;
    decision.kind = "loop closure";
    decision.from = frame.id;
    decision.to = place.id;
    auto closure = factor(place.pose, frame.pose, match);
    if (decision.accepted) {
      const auto predicted = view.covarianceBetween(place.id, frame.id);
      const double chi2 = predicted ? innovation(match, guess, closure, *predicted) : 0;
      decision.accepted = predicted && chi2 <= options_.loop_max_chi2;
      if (predicted) decision.numbers.emplace_back("chi-square", chi2);
      if (!decision.accepted) {
        decision.reason = predicted ? "contradicts the trajectory (chi-square)"
                                    : "the trajectory is not determined well enough to judge";
      }
    }
    if (decision.accepted) {
      closure.loss = graph::Loss::cauchy(options_.loop_loss_scale);
      closure.tags.hypothesis = true;
      batch.addFactor(std::move(closure));
    }
    batch.log(std::move(decision));
  }
}

std::vector<std::size_t> ScanMatchingPlugin::loopCandidates(const map::KeyFrame& frame, const History& history,
                                                            const mapper::View& view) const {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i + 1 < history.size(); ++i) {
    if (history.back().way - history[i].way < options_.loop_min_way) break;
    const auto& place = view.map.keyFrame(history[i].id).map_from_base;
    const double distance = (place.translation() - frame.map_from_base.translation()).norm();
    if (distance <= options_.loop_radius) near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  // The nearest place of each pass: neighbours along the path would only repeat it.
  std::vector<std::size_t> chosen;
  for (const auto& [distance, i] : near) {
    const bool repeats = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
      return std::abs(history[other].way - history[i].way) < options_.loop_min_way;
    });
    if (!repeats) chosen.push_back(i);
    if (chosen.size() == static_cast<std::size_t>(options_.loop_candidates)) break;
  }
  return chosen;
}

matching::PlanarScan ScanMatchingPlugin::localMap(const History& history, std::size_t first, std::size_t last,
                                                  std::size_t centre, const mapper::View& view) const {
  const auto& map_from_centre = view.map.keyFrame(history[centre].id).map_from_base;
  matching::PlanarScan local;
  for (std::size_t i = first; i <= last; ++i) {
    const auto centre_from_frame = planar(view.map.keyFrame(history[i].id).map_from_base - map_from_centre);
    matching::append(history[i].scan_in_base, centre_from_frame, local);
  }
  return local;
}

mapper::Decision ScanMatchingPlugin::judge(const matching::ScanMatch& match, const TPose2D& guess,
                                           const Gate& gate) const {
  const TPose2D correction = match.reference_from_scan - guess;
  const double moved = std::hypot(correction.x, correction.y);
  const double turned = std::abs(mrpt::math::wrapToPi(correction.phi));
  mapper::Decision decision;
  decision.plugin = context_.section;
  decision.numbers = {{"overlap", match.overlap},
                      {"distance from walls [m]", match.wall_distance},
                      {"correction [m]", moved},
                      {"correction [deg]", turned / base::option_text::kRadiansPerDegree}};
  if (match.overlap < gate.min_overlap) {
    decision.reason = "too little overlap";
  } else if (moved > gate.max_correction) {
    decision.reason = "too far from the prediction";
  } else if (turned > gate.max_turn_correction) {
    decision.reason = "turned too far from the prediction";
  } else {
    decision.accepted = true;
    decision.reason = "matched";
  }
  return decision;
}

double ScanMatchingPlugin::innovation(const matching::ScanMatch& match, const TPose2D& guess,
                                      const graph::FactorRecord& closure,
                                      const Eigen::Matrix<double, 6, 6>& predicted) const {
  const TPose2D error = match.reference_from_scan - guess;
  const Eigen::Vector3d difference(error.x, error.y, mrpt::math::wrapToPi(error.phi));
  // In a planar map the noise of the closure is of x y yaw; in a spatial one its planar part is.
  const Eigen::MatrixXd noise = closure.noise.covariance();
  const Eigen::Matrix3d measured = noise.rows() == 3 ? Eigen::Matrix3d(noise) : geometry::planarPart(noise);
  const Eigen::Matrix3d covariance = geometry::planarPart(predicted) + measured;
  return difference.dot(covariance.ldlt().solve(difference));
}

graph::FactorRecord ScanMatchingPlugin::factor(base::VariableId reference, base::VariableId scan,
                                               const matching::ScanMatch& match) const {
  const auto squared = [](double value) { return value * value; };
  Eigen::Matrix3d planar_covariance =
      match.unit_covariance *
      std::max(squared(options_.point_sigma), squared(options_.wall_sigma_factor * match.wall_distance));
  planar_covariance.diagonal() +=
      Eigen::Vector3d(squared(options_.position_sigma_floor), squared(options_.position_sigma_floor),
                      squared(options_.angle_sigma_floor));
  mapper::RelativeMotion motion;
  motion.begin_from_end = mrpt::poses::CPose3D(mrpt::poses::CPose2D(match.reference_from_scan));
  // A scan says nothing of height and tilt: a metre and half a radian, in a spatial map.
  motion.covariance = Eigen::Matrix<double, 6, 6>::Zero();
  motion.covariance.diagonal() << 0, 0, 1.0, 0.25, 0.25, 0;
  const std::array<int, 3> index{0, 1, 5};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      motion.covariance(index[row], index[column]) = planar_covariance(row, column);
    }
  }
  return mapper::betweenPoses(context_.motion, reference, scan, motion, context_.section);
}

namespace {
std::vector<base::OptionSpec> joined(std::vector<base::OptionSpec> a, const std::vector<base::OptionSpec>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<std::string> keysOf(const std::vector<base::OptionSpec>& specs) {
  std::vector<std::string> keys = mapper::sectionKeysOfEngine();
  for (const auto& spec : specs) keys.push_back(spec.key);
  return keys;
}
}  // namespace

const std::vector<base::OptionSpec>& ScanMatchingPluginFactory::options() const {
  static const auto specs = joined(ScanMatchingOptions::table().specs(), matching::IcpOptions::table().specs());
  return specs;
}

std::unique_ptr<mapper::MeasurementPlugin> ScanMatchingPluginFactory::make(const base::ConfigSection& section,
                                                                           const mapper::PluginContext& context) const {
  const auto keys = keysOf(options());
  return std::make_unique<ScanMatchingPlugin>(section.read<ScanMatchingOptions>(keys),
                                              section.read<matching::IcpOptions>(keys), context);
}

}  // namespace omnimapper::plugins
