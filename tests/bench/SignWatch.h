#pragma once

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/plugin/FactoryOf.h>
#include <omnimapper/plugin/OutputPlugin.h>

#include <Eigen/Cholesky>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "TrueSigns.h"

namespace omnimapper::bench {

/// A sign landmark before any landmarks were merged: the true signs of its measurements, and their rays from the true
/// poses of the camera.
struct WatchedSign {
  std::map<std::optional<std::size_t>, int> measurements;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> rays;  ///< in the world: origin [m], direction

  int count() const {
    int all = 0;
    for (const auto& [sign, some] : measurements) all += some;
    return all;
  }
  /// The true sign that most of the measurements are of.
  std::optional<std::size_t> sign() const {
    std::optional<std::size_t> most;
    int best = -1;
    for (const auto& [sign, some] : measurements) {
      if (some <= best) continue;
      best = some;
      most = sign;
    }
    return most;
  }
  int wrong() const { return measurements.empty() ? 0 : count() - measurements.at(sign()); }
  /// The point [m] for which the sum of the squared sines of the angles to all rays is least. Minimizing the distances
  /// to the rays instead would give a point that is too near if they are nearly parallel.
  Eigen::Vector3d place() const {
    constexpr int kRounds = 20;
    constexpr double kDamping = 1e-9;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (int round = 0; round <= kRounds; ++round) {
      Eigen::Matrix3d information = kDamping * Eigen::Matrix3d::Identity();
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const auto& [from, direction] : rays) {
        const Eigen::Vector3d offset = round == 0 ? from : Eigen::Vector3d(point - from);
        const double range = round == 0 ? 1 : std::max(0.2, offset.norm());
        Eigen::Matrix3d by_point = Eigen::Matrix3d::Identity() - direction * direction.transpose();
        const Eigen::Vector3d aside = by_point * offset / range;
        if (round > 0) by_point = (by_point - aside * offset.transpose() / range).eval() / range;
        information += by_point.transpose() * by_point;
        sum += by_point.transpose() * aside;
      }
      const Eigen::Vector3d step = information.ldlt().solve(sum);
      point = round == 0 ? step : Eigen::Vector3d(point - step);
    }
    return point;
  }
};

/// Records hypotheses and merges of sign landmarks while a log is mapped.
struct SignWatch {
  struct Pair {
    base::LandmarkId from, into;
    base::Stamp stamp;
    bool accepted = false;
    bool is_right = false;  ///< both landmarks are the same sign in truth
    std::string reason;
  };
  explicit SignWatch(const SignTruth& known) : truth(&known) {}

  const SignTruth* truth;
  std::map<base::LandmarkId, WatchedSign> signs;
  std::map<base::LandmarkId, std::string> titles;
  std::map<base::FactorId, Pair> hypotheses;
  std::vector<Pair> merges;             ///< pairs of landmarks that were merged in the end
  std::set<base::LandmarkId> repeated;  ///< landmarks with texts for which no hypotheses are proposed any more
  std::map<base::LandmarkId, base::LandmarkId> kept;  ///< the landmark that each became in the end
  std::optional<Eigen::Vector2d> pan_tilt;            ///< [rad] estimated offsets of the camera
  eval::Trajectory online;                            ///< the newest pose, relative to the first one, at each key frame

  void look(const mapper::View& view) {
    const auto& factors = view.graph.factors();
    const auto next = factors.nextId(0);
    for (; next_ < next; ++next_.index) {
      const auto* record = factors.find(next_);
      if (!record) continue;
      if (isDirection(record->factor->kind())) addMeasurement(view, *record);
      if (record->factor->kind() == graph::SamePointFactor::kKind) addHypothesis(view, next_, *record);
    }
    const auto& frames = view.map.key_frames;
    const auto& newest = frames.back();
    if (online.empty() || newest.stamp > online.back().stamp)
      online.push_back({newest.stamp, geometry::fromMrpt(newest.map_from_base - frames.front().map_from_base)});
  }

  void finish(const mapper::View& view) {
    for (const auto& [id, record] : view.graph.variables())
      if (record.kind == graph::panTilt()) pan_tilt = record.value;
    for (const auto& decision : view.decisions) {
      if (!decision.hypothesis) continue;
      const auto at = hypotheses.find(*decision.hypothesis);
      if (at == hypotheses.end()) continue;
      at->second.accepted = decision.accepted;
      at->second.stamp = decision.stamp;
      at->second.reason = decision.reason;
    }
    for (const auto& [id, landmark] : view.map.landmarks) {
      if (signs.count(id) == 0) continue;
      kept[id] = view.map.landmark(id).id;
      if (landmark.payload)
        titles[id] = landmark.payload->shape({Eigen::Vector3d::Zero()}, view.map.key_frames).caption;
      if (landmark.state == map::Landmark::State::merged)
        merges.push_back({landmark.merged_into, id, landmark.last_seen, true, false, "merged"});
    }
    for (auto& [id, pair] : hypotheses) pair.is_right = areSameSign(pair.from, pair.into);
    for (auto& pair : merges) pair.is_right = areSameSign(pair.from, pair.into);
  }

  bool areSameSign(base::LandmarkId a, base::LandmarkId b) const {
    constexpr double kSamePlace = 0.5;  // [m]
    const auto &first = signs.at(a), &second = signs.at(b);
    if (first.sign() && second.sign()) return first.sign() == second.sign();
    return (first.place() - second.place()).norm() < kSamePlace;
  }

  std::string nameOf(base::LandmarkId id) const {
    const auto sign = signs.at(id).sign();
    return sign ? truth->names[*sign] : "no sign";
  }

 private:
  static bool isDirection(std::string_view kind) { return kind == "sign_bearing" || kind == "sign_bearing_pan_tilt"; }
  void addMeasurement(const mapper::View& view, const graph::FactorRecord& record) {
    std::stringstream bytes;
    record.factor->write(bytes);
    const Eigen::Vector3d camera = graph::readVector<3>(bytes), direction = graph::readVector<3>(bytes);
    const auto stamp = stampOf(view, record.variables[0]);
    if (!stamp) return;
    auto& sign = signs[*record.tags.landmark];
    ++sign.measurements[truth->signOf(*stamp, direction)];
    const auto base = eval::interpolatedPose(truth->trajectory, *stamp, base::durationFromSeconds(1));
    if (!base) return;
    sign.rays.emplace_back(*base * camera, base->rotation * direction);
  }

  void addHypothesis(const mapper::View& view, base::FactorId id, const graph::FactorRecord& record) {
    if (!record.tags.hypothesis) return;
    std::optional<base::LandmarkId> ids[2];
    for (const auto& [landmark, each] : view.map.landmarks)
      for (int i = 0; i < 2; ++i)
        if (!each.variables.empty() && each.variables.front() == record.variables[static_cast<std::size_t>(i)])
          ids[i] = landmark;
    if (ids[0] && ids[1] && signs.count(*ids[0]) > 0 && signs.count(*ids[1]) > 0)
      hypotheses[id] = {*ids[0], *ids[1], {}, false, false, {}};
  }

  std::optional<base::Stamp> stampOf(const mapper::View& view, base::VariableId pose) {
    auto at = stamps_.find(pose);
    if (at == stamps_.end()) {
      for (const auto& frame : view.map.key_frames) stamps_[frame.pose] = frame.stamp;
      at = stamps_.find(pose);
    }
    return at == stamps_.end() ? std::nullopt : std::optional(at->second);
  }

  base::FactorId next_;
  std::map<base::VariableId, base::Stamp> stamps_;
};

struct NoOptions {
  static const base::OptionTable<NoOptions>& table() {
    static const base::OptionTable<NoOptions> table;
    return table;
  }
};

/// Output plugin that passes a run to `watch`, which must exist until the run has ended.
class SignWatchOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "SignWatchOutput";
  static constexpr const char* kSummary = "Records for a benchmark which signs the mapper associates.";

  explicit SignWatchOutput(const NoOptions& /*options*/) {}

  inline static SignWatch* watch = nullptr;

  void keyFrameAdded(const mapper::View& view) override {
    if (watch) watch->look(view);
  }
  void finish(const mapper::View& view) override {
    if (watch) watch->finish(view);
  }
};

}  // namespace omnimapper::bench
