#include "Relations.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/graph/Linearised.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "PlaneVariable.h"
#include "RelationFactors.h"
#include "WallVariable.h"

namespace omnimapper::plugins {

namespace {

using geometry::kPi;

/// A landmark as relations see it.
struct Thing {
  base::LandmarkId id;
  base::VariableId variable;
  std::string_view kind;  // of the variable
  map::LandmarkShape shape;
};

/// What a relation says, and how much room there is for its residual if it does not hold.
struct Claim {
  std::string name;
  std::shared_ptr<const graph::Factor> factor;
  Eigen::VectorXd sigmas;
  double room;  // in the units of the residual
};

std::vector<Eigen::Vector3d> outlineOf(const map::LandmarkShape& shape) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& surface : shape.surfaces)
    corners.insert(corners.end(), surface.vertices.begin(), surface.vertices.end());
  for (const auto& [from, to] : shape.lines) {
    corners.push_back(from);
    corners.push_back(to);
  }
  return corners;
}

// Stretch of a thing along a level direction [m].
std::optional<std::pair<double, double>> stretch(const Thing& thing, const Eigen::Vector3d& along) {
  const auto corners = outlineOf(thing.shape);
  if (corners.empty()) return std::nullopt;
  std::pair<double, double> found{1e300, -1e300};
  for (const auto& corner : corners) {
    found.first = std::min(found.first, along.dot(corner));
    found.second = std::max(found.second, along.dot(corner));
  }
  return found;
}

class Finder {
 public:
  Finder(const mapper::State& state, const RelationsOptions& options, const KnownRelations& known)
      : state_(state), options_(options), known_(known) {
    for (const auto& [id, landmark] : state.map.landmarks) {
      if (landmark.state != map::Landmark::State::active || landmark.variables.size() != 1) continue;
      if (landmark.evidence < static_cast<std::uint32_t>(options.min_sightings)) continue;
      const auto variable = landmark.variables.front();
      map::LandmarkShape shape;
      if (landmark.payload) shape = landmark.payload->shape({state.graph.value(variable)}, state.map.key_frames);
      things_.push_back({id, variable, state.graph.variable(variable).kind->kind(), std::move(shape)});
    }
  }

  std::vector<Relation> find() {
    for (std::size_t i = 0; i < things_.size(); ++i)
      for (std::size_t j = 0; j < things_.size(); ++j) {
        const Thing &a = things_[i], &b = things_[j];
        if (a.kind == "point2" && b.kind == "wall") pointOnWall(a, b);
        if (a.kind == "point3" && b.kind == "plane") pointOnPlane(a, b);
        if (j <= i || a.kind != b.kind) continue;
        if (a.kind == "wall") twoWalls(a, b);
        if (a.kind == "plane") twoPlanes(a, b);
      }
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Relation& a, const Relation& b) { return a.likelihood_ratio > b.likelihood_ratio; });
    thin();
    return std::move(found_);
  }

 private:
  // Of what says the same twice the likelier stays.
  void thin() {
    std::map<base::VariableId, base::VariableId> parents;
    const auto root = [&](base::VariableId id) {
      for (auto up = parents.find(id); up != parents.end(); up = parents.find(id)) id = up->second;
      return id;
    };
    const auto join = [&](base::VariableId a, base::VariableId b) {
      const auto root_a = root(a), root_b = root(b);
      if (root_a == root_b) return false;
      parents[root_a] = root_b;
      return true;
    };
    for (const auto& [pair, acts] : known_)
      if (acts) join(pair.second.first, pair.second.second);
    std::set<base::VariableId> placed;
    found_.erase(std::remove_if(found_.begin(), found_.end(),
                                [&](const Relation& relation) {
                                  const auto& ids = relation.record.variables;
                                  const auto kind = state_.graph.variable(ids[0]).kind->kind();
                                  const bool is_point = kind == "point2" || kind == "point3";
                                  return !(is_point ? placed.insert(ids[0]).second : join(ids[0], ids[1]));
                                }),
                 found_.end());
  }

  Eigen::VectorXd sigmas(int angles, int distances) const {
    Eigen::VectorXd all(angles + distances);
    all.head(angles).setConstant(options_.angle_sigma);
    all.tail(distances).setConstant(options_.distance_sigma);
    return all;
  }
  bool isPlaced(base::VariableId point) const {
    return std::any_of(known_.begin(), known_.end(), [&](const auto& relation) {
      const auto& [first, second] = relation.first.second;
      return relation.second && (first == point || second == point);
    });
  }

  void pointOnWall(const Thing& point, const Thing& wall) {
    if (!options_.point_on_wall || isPlaced(point.variable)) return;
    const geometry::Segment2 segment = wallFromValue(state_.graph.value(wall.variable).data());
    const Eigen::Vector2d place = state_.graph.value(point.variable), along = direction(segment);
    if (std::abs(normalOf(segment).dot(place - segment.from)) > options_.max_distance) return;
    const auto reach =
        stretch(wall, {along.x(), along.y(), 0}).value_or(std::pair(along.dot(segment.from), along.dot(segment.to)));
    if (along.dot(place) < reach.first - kBeyond || along.dot(place) > reach.second + kBeyond) return;
    weigh(point, wall,
          {"point on wall", std::make_shared<PointOnWallFactor>(), sigmas(0, 1), 2 * options_.max_distance});
  }

  void pointOnPlane(const Thing& point, const Thing& plane) {
    if (!options_.point_on_wall || isPlaced(point.variable)) return;
    const geometry::Plane3 surface = planeFromValue(state_.graph.value(plane.variable).data());
    const Eigen::Vector3d place = state_.graph.value(point.variable);
    if (std::abs(signedDistance(surface, place)) > options_.max_distance) return;
    const auto corners = outlineOf(plane.shape);
    if (corners.empty()) return;
    Eigen::Vector3d low = corners.front(), high = low;
    for (const auto& corner : corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const double beyond = kBeyond + options_.max_distance;
    const bool level = std::abs(surface.normal.z()) > 0.5;
    const int axes = level ? 3 : 2;  // how high a wall goes nobody may have seen
    if ((place.head(axes).array() < low.head(axes).array() - beyond).any() ||
        (place.head(axes).array() > high.head(axes).array() + beyond).any())
      return;
    weigh(point, plane,
          {"point on surface", std::make_shared<PointOnPlaneFactor>(), sigmas(0, 1), 2 * options_.max_distance});
  }

  void twoWalls(const Thing& a, const Thing& b) {
    const geometry::Segment2 of_a = wallFromValue(state_.graph.value(a.variable).data()),
                             of_b = wallFromValue(state_.graph.value(b.variable).data());
    const Eigen::Vector2d along_a = direction(of_a), along_b = direction(of_b);
    const double turn = std::atan2(along_a.x() * along_b.y() - along_a.y() * along_b.x(), along_a.dot(along_b));
    const int quarters = static_cast<int>(std::lround(turn / (kPi / 2)));
    if (std::abs(turn - quarters * kPi / 2) > options_.max_angle) return;
    const bool one_line =
        quarters == 0 && std::abs(normalOf(of_a).dot(middle(of_b) - middle(of_a))) < options_.max_distance;
    if (options_.aligned && one_line &&
        weigh(a, b,
              {"on one line", std::make_shared<WallsAlignedFactor>(), sigmas(1, 1),
               2 * options_.max_angle * 2 * options_.max_distance}))
      return;
    if (quarters % 2 == 0 ? options_.parallel : options_.perpendicular)
      weigh(a, b,
            {quarters % 2 == 0 ? "parallel" : "perpendicular", std::make_shared<WallTurnFactor>(quarters), sigmas(1, 0),
             2 * options_.max_angle});
  }

  void twoPlanes(const Thing& a, const Thing& b) {
    const geometry::Plane3 of_a = planeFromValue(state_.graph.value(a.variable).data()),
                           of_b = planeFromValue(state_.graph.value(b.variable).data());
    const double together = of_a.normal.dot(of_b.normal), reach = std::sin(options_.max_angle);
    if (of_a.normal.cross(of_b.normal).norm() < reach) {
      const auto corners = outlineOf(b.shape);
      if (options_.aligned && together > 0 && !corners.empty()) {
        Eigen::Vector3d near = Eigen::Vector3d::Zero();
        for (const auto& corner : corners) near += corner / static_cast<double>(corners.size());
        const bool one_plane = std::abs(signedDistance(of_a, near)) < options_.max_distance;
        if (one_plane && weigh(a, b,
                               {"on one plane", std::make_shared<PlanesAlignedFactor>(near), sigmas(2, 1),
                                4 * reach * reach * 2 * options_.max_distance}))
          return;
      }
      if (options_.parallel)
        weigh(a, b, {"parallel", std::make_shared<PlanesParallelFactor>(), sigmas(2, 0), 4 * reach * reach});
    } else if (std::abs(together) < reach && options_.perpendicular) {
      weigh(a, b, {"perpendicular", std::make_shared<PlanesSquareFactor>(), sigmas(1, 0), 2 * reach});
    }
  }

  // Whether it is likelier than not, now or when it was found.
  bool weigh(const Thing& a, const Thing& b, const Claim& claim) {
    Relation relation{{std::string(claim.factor->kind()), std::minmax(a.variable, b.variable)},
                      {{a.variable, b.variable}, claim.factor, graph::SquareRootInformation::fromSigmas(claim.sigmas)},
                      claim.name};
    if (known_.count(relation.pair) > 0) return true;
    const auto joint = state_.jointCovariance(relation.record.variables);
    if (!joint) return false;
    const graph::Linearised linearised(state_.graph, relation.record);
    Eigen::MatrixXd jacobian(linearised.residual.size(), joint->cols());
    jacobian << linearised.jacobians[0], linearised.jacobians[1];
    Eigen::MatrixXd covariance = jacobian * *joint * jacobian.transpose();
    covariance.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const auto rows = static_cast<int>(linearised.residual.size());
    relation.chi2 = linearised.residual.dot(root.solve(linearised.residual));
    constexpr double kConfidence = 0.999;
    if (relation.chi2 > graph::chiSquareQuantile(kConfidence, rows)) return false;
    // Both densities in whitened units.
    const double log_room = std::log(claim.room) - claim.sigmas.array().log().sum();
    const double log_density = -0.5 * (relation.chi2 + rows * std::log(2 * kPi)) -
                               Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
    relation.likelihood_ratio = std::exp(std::min(log_density + log_room, 50.0));
    if (relation.likelihood_ratio < options_.min_likelihood_ratio) return false;
    relation.record.tags.landmark = a.id;
    relation.record.tags.note = relation.name;
    found_.push_back(std::move(relation));
    return true;
  }

  static constexpr double kBeyond = 0.2;  // [m] a point may lie beyond what was seen of its wall

  const mapper::State& state_;
  const RelationsOptions& options_;
  const KnownRelations& known_;
  std::vector<Thing> things_;
  std::vector<Relation> found_;
};

}  // namespace

std::vector<Relation> findRelations(const mapper::State& state, const RelationsOptions& options,
                                    const KnownRelations& known) {
  return Finder(state, options, known).find();
}

}  // namespace omnimapper::plugins
