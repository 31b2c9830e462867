#pragma once

#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Consistency.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <Eigen/Geometry>
#include <random>

#include "relations/RelationFactors.h"
#include "relations/Relations.h"

namespace omnimapper::plugins {

/// The simulated experiment of thesis 4.5.2.4: a box of 6 x 7 m with points on its walls and some within, seen from 40
/// poses on a circle. Lines are measured to 0.02 m at each end, points with a variance of 0.1 m^2, as in the thesis,
/// which does not give the odometry (here 0.03 m and 1 deg a step) and the number of points (here 24 on walls, 4
/// within).
class RelationBox {
 public:
  enum class With { no_relations, found, true_ones };

  explicit RelationBox(unsigned seed) : random_(seed) {
    const std::vector<Eigen::Vector2d> corners = {{-3, -3.5}, {-3, 3.5}, {3, 3.5}, {3, -3.5}};  // free on the right...
    for (std::size_t i = 0; i < corners.size(); ++i) walls_.push_back({corners[(i + 1) % 4], corners[i]});  // ...left
    for (const auto& wall : walls_)
      for (int i = 0; i < kPointsOnWall; ++i)
        points_.push_back(wall.from + uniform(0.05, 0.95) * (wall.to - wall.from));
    for (int i = 0; i < kPointsWithin; ++i) points_.emplace_back(uniform(-2.2, 2.2), uniform(-2.7, 2.7));
    drive();
  }

  /// The true or estimated positions of everything in the map [m].
  struct Layout {
    std::vector<Eigen::Vector2d> poses, points;
    std::vector<geometry::Segment2> walls;
  };
  Layout truth() const {
    Layout layout{{}, points_, walls_};
    for (const auto& pose : truth_) layout.poses.push_back(pose.translation());
    return layout;
  }
  /// Estimates before the first solve.
  Layout initialBelief() const { return layoutOf(measured_); }

  struct Error {
    double pose = 0, landmark = 0;            // mean [m]
    double pose_nees = 0, landmark_nees = 0;  // of the last pose, 3 degrees of freedom; of the first point, 2
    // Numbers of relations that were proposed, refused, and accepted though false.
    int relations = 0, refused = 0, wrong = 0;
    Layout found;
  };
  /// `wrong`: number of false relations among those that are proposed; all act at once unless `tested`.
  Error run(With with, int wrong, bool tested) {
    graph::Graph graph = measured_;
    graph::solve(graph);
    Error error;
    std::vector<base::FactorId> hypotheses;
    std::set<base::FactorId> false_ones;
    const auto add = [&](graph::FactorRecord record, bool is_false) {
      record.tags.hypothesis = tested;
      record.weight = tested ? 0 : 1;
      const auto id = graph.addFactor(std::move(record));
      if (tested) hypotheses.push_back(id);
      if (is_false) false_ones.insert(id);
      ++error.relations;
    };
    for (int i = 0; i < wrong; ++i) add(falseRelation(i), true);
    if (with == With::true_ones) {
      for (std::size_t i = 0; i < walls_.size() * kPointsOnWall; ++i) add(onWall(i, i / kPointsOnWall), false);
      for (std::size_t i = 1; i < walls_.size(); ++i)
        add(record({wall_ids_[0], wall_ids_[i]}, std::make_shared<WallTurnFactor>(-static_cast<int>(i)), kAngleSigma),
            false);
    }
    settle(graph, hypotheses);
    // A better estimate may show more relations, so this is repeated until no new one is found.
    for (int round = 0; with == With::found && round < 3; ++round) {
      hypotheses.clear();
      for (auto& relation : findRelations(stateOf(graph), options_, known(graph))) add(relation.record, false);
      if (hypotheses.empty()) break;
      settle(graph, hypotheses);
    }
    for (const auto& [id, record] : graph.factors()) {
      error.refused += record.tags.hypothesis && record.weight == 0;
      error.wrong += (false_ones.count(id) > 0 || isFalse(record)) && record.weight > 0;
    }
    judge(graph, error);
    error.found = layoutOf(graph);
    return error;
  }

 private:
  static constexpr int kPointsOnWall = 6, kPointsWithin = 4, kPoses = 40;
  static constexpr double kAngleSigma = 0.01, kDistanceSigma = 0.02;

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double normal(double sigma) { return sigma * std::normal_distribution<double>()(random_); }

  void drive() {
    const Eigen::Vector3d odometry_sigmas(0.03, 0.03, geometry::kPi / 180);
    geometry::Se2 believed{2, 0, geometry::kPi / 2};
    for (int i = 0; i < kPoses; ++i) {
      const double angle = 2 * geometry::kPi * i / kPoses;
      truth_.push_back({2 * std::cos(angle), 2 * std::sin(angle), geometry::wrapToPi(angle + geometry::kPi / 2)});
      if (i > 0) {
        const Eigen::Vector3d error(normal(odometry_sigmas[0]), normal(odometry_sigmas[1]), normal(odometry_sigmas[2]));
        const geometry::Se2 moved = plus(inverse(truth_[i - 1]) * truth_[i], error);
        believed = believed * moved;
        pose_ids_.push_back(measured_.addVariable(graph::se2(), graph::toValue(believed)));
        measured_.addFactor({{pose_ids_[i - 1], pose_ids_[i]},
                             std::make_shared<graph::BetweenSe2>(moved),
                             graph::SquareRootInformation::fromSigmas(odometry_sigmas)});
      } else {
        pose_ids_.push_back(measured_.addVariable(graph::se2(), graph::toValue(believed), true));
      }
      see(i, believed);
    }
    for (const auto id : wall_ids_) addLandmark(id);
    for (const auto id : point_ids_) addLandmark(id);
  }

  void see(int pose, const geometry::Se2& believed) {
    constexpr double kEndSigma = 0.02;
    const double point_sigma = std::sqrt(0.1);
    const geometry::Se2 base_from_map = inverse(truth_[pose]);
    const auto noisy = [&](const Eigen::Vector2d& in_map, double sigma) -> Eigen::Vector2d {
      return base_from_map * in_map + Eigen::Vector2d(normal(sigma), normal(sigma));
    };
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const geometry::Segment2 seen{noisy(walls_[i].from, kEndSigma), noisy(walls_[i].to, kEndSigma)};
      if (pose == 0)
        wall_ids_.push_back(measured_.addVariable(plane_factors::wallVariable(),
                                                  plane_factors::toValue({believed * seen.from, believed * seen.to})));
      const Eigen::Vector2d sigmas(kEndSigma * std::sqrt(2.0) / length(walls_[i]), kEndSigma / std::sqrt(2.0));
      measured_.addFactor({{pose_ids_[pose], wall_ids_[i]},
                           std::make_shared<plane_factors::WallFactor>(direction(seen), middle(seen)),
                           graph::SquareRootInformation::fromSigmas(sigmas)});
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector2d seen = noisy(points_[i], point_sigma);
      if (pose == 0) point_ids_.push_back(measured_.addVariable(graph::point2(), believed * seen));
      measured_.addFactor({{pose_ids_[pose], point_ids_[i]},
                           std::make_shared<graph::PointFactor2>(seen),
                           graph::SquareRootInformation::fromSigmas(Eigen::Vector2d(point_sigma, point_sigma))});
    }
  }

  void addLandmark(base::VariableId variable) {
    map::Landmark landmark;
    landmark.id = map_.landmarks.nextId(0);
    landmark.variables = {variable};
    landmark.evidence = kPoses;
    map_.landmarks.add(0, std::move(landmark));
  }

  graph::FactorRecord record(std::vector<base::VariableId> ids, std::shared_ptr<const graph::Factor> factor,
                             double sigma) const {
    return {std::move(ids), std::move(factor),
            graph::SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, sigma))};
  }
  graph::FactorRecord onWall(std::size_t point, std::size_t wall) const {
    return record({point_ids_[point], wall_ids_[wall]}, std::make_shared<PointOnWallFactor>(), kDistanceSigma);
  }
  // A point within the room, stated to be on the nearest wall; then points of other walls.
  graph::FactorRecord falseRelation(int number) const {
    if (number >= kPointsWithin) {
      const auto point = static_cast<std::size_t>((number - kPointsWithin) * kPointsOnWall);
      return onWall(point, (point / kPointsOnWall + 1) % walls_.size());
    }
    const std::size_t point = walls_.size() * kPointsOnWall + static_cast<std::size_t>(number);
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < walls_.size(); ++i)
      if (distance(walls_[i], points_[point]) < distance(walls_[nearest], points_[point])) nearest = i;
    return onWall(point, nearest);
  }
  bool isFalse(const graph::FactorRecord& relation) const {
    if (relation.factor->kind() != "point_on_wall") return false;
    const auto point = std::find(point_ids_.begin(), point_ids_.end(), relation.variables[0]) - point_ids_.begin();
    const auto wall = std::find(wall_ids_.begin(), wall_ids_.end(), relation.variables[1]) - wall_ids_.begin();
    return distance(walls_[wall], points_[point]) > 1e-6;
  }

  mapper::State stateOf(const graph::Graph& graph) {
    uncertainty_ = mapper::Uncertainty(graph);
    return {map_, graph, uncertainty_};
  }
  static KnownRelations known(const graph::Graph& graph) {
    KnownRelations known;
    for (const auto& [id, record] : graph.factors())
      if (record.tags.hypothesis)
        known[{std::string(record.factor->kind()), std::minmax(record.variables[0], record.variables[1])}] =
            record.weight > 0;
    return known;
  }
  static void settle(graph::Graph& graph, const std::vector<base::FactorId>& hypotheses) {
    if (hypotheses.empty()) {
      graph::solve(graph);
    } else {
      graph::testConsistency(graph, hypotheses);
    }
  }

  Layout layoutOf(const graph::Graph& graph) const {
    Layout layout;
    for (const auto id : pose_ids_) layout.poses.emplace_back(graph.value(id).head<2>());
    for (const auto id : point_ids_) layout.points.emplace_back(graph.value(id));
    for (const auto id : wall_ids_) layout.walls.push_back(plane_factors::wallFromValue(graph.value(id).data()));
    return layout;
  }

  void judge(const graph::Graph& graph, Error& error) const {
    for (int i = 0; i < kPoses; ++i) {
      const Eigen::Vector2d at = graph.value(pose_ids_[i]).head<2>();
      error.pose += (at - truth_[i].translation()).norm() / kPoses;
    }
    for (std::size_t i = 0; i < points_.size(); ++i)
      error.landmark += (graph.value(point_ids_[i]) - points_[i]).norm() / static_cast<double>(points_.size());
    const graph::Marginals marginals(graph);
    const Eigen::Vector3d off = minus(graph::se2FromValue(graph.value(pose_ids_.back()).data()), truth_.back());
    error.pose_nees = off.dot(marginals.covariance(pose_ids_.back()).llt().solve(off));
    const Eigen::Vector2d point_off = graph.value(point_ids_[0]) - points_[0];
    error.landmark_nees = point_off.dot(marginals.covariance(point_ids_[0]).llt().solve(point_off));
  }

  std::mt19937 random_;
  std::vector<geometry::Segment2> walls_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<geometry::Se2> truth_;
  graph::Graph measured_;
  std::vector<base::VariableId> pose_ids_, wall_ids_, point_ids_;
  map::Map map_;
  mapper::Uncertainty uncertainty_;
  RelationsOptions options_;
};

}  // namespace omnimapper::plugins
