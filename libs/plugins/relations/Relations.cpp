#include "Relations.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/graph/Linearized.h>
#include <omnimapper/plane_factors/PlaneAxes.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "RelationClosure.h"
#include "RelationFactors.h"

namespace omnimapper::plugins {

namespace {

using geometry::kPi;

/// The properties of a landmark that relations depend on.
struct LandmarkView {
  base::LandmarkId id;
  base::VariableId variable;
  std::string_view kind;  // of the variable
  map::LandmarkShape shape;
};

/// A possible relation, with the size of the range in which its residual lies if it does not hold.
struct RelationHypothesis {
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

// Extent of a landmark along a level direction: smallest and largest coordinate [m].
std::optional<std::pair<double, double>> stretch(const LandmarkView& landmark, const Eigen::Vector3d& along) {
  const auto corners = outlineOf(landmark.shape);
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
      : state_(state), options_(options), known_(known), closure_(known) {
    for (const auto& [id, landmark] : state.map.landmarks) {
      if (landmark.state != map::Landmark::State::active || landmark.variables.size() != 1) continue;
      if (landmark.evidence < static_cast<std::uint32_t>(options.min_measurements)) continue;
      const auto variable = landmark.variables.front();
      map::LandmarkShape shape;
      if (landmark.payload) shape = landmark.payload->shape({state.graph.value(variable)}, state.map.key_frames);
      views_.push_back({id, variable, state.graph.variable(variable).kind->kind(), std::move(shape)});
    }
  }

  std::vector<Relation> find() {
    for (std::size_t i = 0; i < views_.size(); ++i)
      for (std::size_t j = 0; j < views_.size(); ++j) {
        const LandmarkView &a = views_[i], &b = views_[j];
        if (!mayBeRelated(a, b)) continue;
        if (a.kind == "point2" && b.kind == "wall") pointOnWall(a, b, std::make_shared<PointOnWallFactor>());
        if (a.kind == "point3" && b.kind == "wall") pointOnWall(a, b, std::make_shared<Point3OnWallFactor>());
        if (a.kind == "point3" && b.kind == "plane") pointOnPlane(a, b);
        if (j <= i || a.kind != b.kind) continue;
        if (a.kind == "wall") twoWalls(a, b);
        if (a.kind == "plane") twoPlanes(a, b);
      }
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Relation& a, const Relation& b) { return a.likelihood_ratio > b.likelihood_ratio; });
    // If several relations state the same, the likeliest is kept.
    found_.erase(std::remove_if(found_.begin(), found_.end(),
                                [&](const Relation& relation) {
                                  const auto& ids = relation.record.variables;
                                  return !closure_.add(relation.record.factor->kind(), ids[0], ids[1]);
                                }),
                 found_.end());
    return std::move(found_);
  }

 private:
  // The place of a session that is not aligned is unknown, and relations must not determine it.
  bool mayBeRelated(const LandmarkView& a, const LandmarkView& b) const {
    return a.variable.session == b.variable.session || (isAligned(a) && isAligned(b));
  }
  bool isAligned(const LandmarkView& landmark) const {
    const auto& sessions = state_.map.sessions;
    return std::all_of(sessions.begin(), sessions.end(), [&](const map::Session& session) {
      return session.number != landmark.variable.session || session.aligned;
    });
  }

  Eigen::VectorXd sigmas(int angles, int distances) const {
    Eigen::VectorXd all(angles + distances);
    all.head(angles).setConstant(options_.angle_sigma);
    all.tail(distances).setConstant(options_.distance_sigma);
    return all;
  }

  void pointOnWall(const LandmarkView& point, const LandmarkView& wall, std::shared_ptr<const graph::Factor> factor) {
    if (!options_.point_on_wall || closure_.isPlaced(point.variable)) return;
    const geometry::Segment2 segment = plane_factors::wallFromValue(state_.graph.value(wall.variable).data());
    const Eigen::Vector2d place = state_.graph.value(point.variable).head<2>(), along = direction(segment);
    if (std::abs(plane_factors::normalOf(segment).dot(place - segment.from)) > options_.max_distance) return;
    const auto reach =
        stretch(wall, {along.x(), along.y(), 0}).value_or(std::pair(along.dot(segment.from), along.dot(segment.to)));
    if (along.dot(place) < reach.first - kBeyond || along.dot(place) > reach.second + kBeyond) return;
    weigh(point, wall, {"point on wall", std::move(factor), sigmas(0, 1), 2 * options_.max_distance});
  }

  void pointOnPlane(const LandmarkView& point, const LandmarkView& plane) {
    if (!options_.point_on_wall || closure_.isPlaced(point.variable)) return;
    const geometry::Plane3 surface = plane_factors::planeFromValue(state_.graph.value(plane.variable).data());
    const Eigen::Vector3d place = state_.graph.value(point.variable);
    if (std::abs(signedDistance(surface, place)) > options_.max_distance) return;
    const auto corners = outlineOf(plane.shape);
    if (corners.empty()) return;
    const plane_factors::PlaneAxes axes(surface);
    const bool upright = std::abs(surface.normal.z()) < 0.5;  // the height of a wall may be seen only in part
    const auto dropped = [&](const Eigen::Vector3d& at) {
      const Eigen::Vector2d on_plane = axes.onto(at);
      return upright ? Eigen::Vector2d(on_plane.x(), 0) : on_plane;
    };
    std::vector<Eigen::Vector2d> seen;
    for (const auto& corner : corners) seen.push_back(dropped(corner));
    if (geometry::distance(geometry::convexHull(std::move(seen)), {dropped(place)}) > kBeyond) return;
    weigh(point, plane,
          {"point on surface", std::make_shared<PointOnPlaneFactor>(), sigmas(0, 1), 2 * options_.max_distance});
  }

  void twoWalls(const LandmarkView& a, const LandmarkView& b) {
    const bool angle_known = closure_.isAngleKnown(a.variable, b.variable);
    const bool may_align = options_.aligned && !closure_.isAligned(a.variable, b.variable);
    if (angle_known && !may_align) return;
    const geometry::Segment2 of_a = plane_factors::wallFromValue(state_.graph.value(a.variable).data()),
                             of_b = plane_factors::wallFromValue(state_.graph.value(b.variable).data());
    const Eigen::Vector2d along_a = direction(of_a), along_b = direction(of_b);
    const double turn = std::atan2(along_a.x() * along_b.y() - along_a.y() * along_b.x(), along_a.dot(along_b));
    const int quarters = static_cast<int>(std::lround(turn / (kPi / 2)));
    if (std::abs(turn - quarters * kPi / 2) > options_.max_angle) return;
    const bool one_line = quarters == 0 && std::abs(plane_factors::normalOf(of_a).dot(middle(of_b) - middle(of_a))) <
                                               options_.max_distance;
    if (may_align && one_line && wallsAligned(a, b, angle_known)) return;
    if (!angle_known && (quarters % 2 == 0 ? options_.parallel : options_.perpendicular))
      weigh(a, b,
            {quarters % 2 == 0 ? "parallel" : "perpendicular", std::make_shared<WallTurnFactor>(quarters), sigmas(1, 0),
             2 * options_.max_angle});
  }

  // If the angle of the walls is already known, only their shift is related.
  bool wallsAligned(const LandmarkView& a, const LandmarkView& b, bool angle_known) {
    if (isKnown("walls_aligned", a, b) || isKnown("wall_shift", a, b)) return false;
    const double room = 2 * options_.max_distance;
    if (angle_known) return weigh(a, b, {"on one line", std::make_shared<WallShiftFactor>(), sigmas(0, 1), room});
    return weigh(a, b,
                 {"on one line", std::make_shared<WallsAlignedFactor>(), sigmas(1, 1), 2 * options_.max_angle * room});
  }

  void twoPlanes(const LandmarkView& a, const LandmarkView& b) {
    const geometry::Plane3 of_a = plane_factors::planeFromValue(state_.graph.value(a.variable).data()),
                           of_b = plane_factors::planeFromValue(state_.graph.value(b.variable).data());
    const double together = of_a.normal.dot(of_b.normal), reach = std::sin(options_.max_angle);
    if (of_a.normal.cross(of_b.normal).norm() < reach) {
      const bool angle_known = closure_.isAngleKnown(a.variable, b.variable);
      if (options_.aligned && together > 0 && !closure_.isAligned(a.variable, b.variable) &&
          planesAligned(a, b, of_a, angle_known))
        return;
      if (options_.parallel && !angle_known)
        weigh(a, b, {"parallel", std::make_shared<PlanesParallelFactor>(), sigmas(2, 0), 4 * reach * reach});
    } else if (std::abs(together) < reach && options_.perpendicular && !closure_.areSquare(a.variable, b.variable)) {
      weigh(a, b, {"perpendicular", std::make_shared<PlanesSquareFactor>(), sigmas(1, 0), 2 * reach});
    }
  }

  bool planesAligned(const LandmarkView& a, const LandmarkView& b, const geometry::Plane3& of_a, bool angle_known) {
    const auto corners = outlineOf(b.shape);
    if (corners.empty() || isKnown("planes_aligned", a, b) || isKnown("plane_shift", a, b)) return false;
    Eigen::Vector3d near = Eigen::Vector3d::Zero();
    for (const auto& corner : corners) near += corner / static_cast<double>(corners.size());
    if (std::abs(signedDistance(of_a, near)) > options_.max_distance) return false;
    const double reach = std::sin(options_.max_angle), room = 2 * options_.max_distance;
    if (angle_known) return weigh(a, b, {"on one plane", std::make_shared<PlaneShiftFactor>(near), sigmas(0, 1), room});
    return weigh(a, b,
                 {"on one plane", std::make_shared<PlanesAlignedFactor>(near), sigmas(2, 1), 4 * reach * reach * room});
  }

  static RelatedPair pairOf(std::string_view kind, const LandmarkView& a, const LandmarkView& b) {
    return {std::string(kind), std::minmax(a.variable, b.variable)};
  }
  bool isKnown(std::string_view kind, const LandmarkView& a, const LandmarkView& b) const {
    return known_.count(pairOf(kind, a, b)) > 0;
  }

  // Adds the relation if it is likely enough, and returns whether it did. A relation that was proposed before is not
  // proposed again: the consistency test keeps it.
  bool weigh(const LandmarkView& a, const LandmarkView& b, const RelationHypothesis& hypothesis) {
    if (isKnown(hypothesis.factor->kind(), a, b)) return false;
    Relation relation{
        pairOf(hypothesis.factor->kind(), a, b),
        {{a.variable, b.variable}, hypothesis.factor, graph::SquareRootInformation::fromSigmas(hypothesis.sigmas)},
        hypothesis.name};
    const auto joint = state_.jointCovariance(relation.record.variables);
    if (!joint) return false;
    const graph::Linearized linearized(state_.graph, relation.record);
    Eigen::MatrixXd jacobian(linearized.residual.size(), joint->cols());
    jacobian << linearized.jacobians[0], linearized.jacobians[1];
    Eigen::MatrixXd covariance = jacobian * *joint * jacobian.transpose();
    covariance.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const auto rows = static_cast<int>(linearized.residual.size());
    relation.chi2 = linearized.residual.dot(root.solve(linearized.residual));
    constexpr double kConfidence = 0.999;
    if (relation.chi2 > graph::chiSquareQuantile(kConfidence, rows)) return false;
    // Both densities are in whitened units.
    const double log_room = std::log(hypothesis.room) - hypothesis.sigmas.array().log().sum();
    const double log_density = -0.5 * (relation.chi2 + rows * std::log(2 * kPi)) -
                               Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
    relation.likelihood_ratio = std::exp(std::min(log_density + log_room, 50.0));
    if (relation.likelihood_ratio < options_.min_likelihood_ratio) return false;
    relation.record.tags.landmark = a.id;
    relation.record.tags.note = relation.name;
    found_.push_back(std::move(relation));
    return true;
  }

  static constexpr double kBeyond = 0.2;  // [m] by which a point may lie beyond the seen part of its wall

  const mapper::State& state_;
  const RelationsOptions& options_;
  const KnownRelations& known_;
  RelationClosure closure_;
  std::vector<LandmarkView> views_;
  std::vector<Relation> found_;
};

}  // namespace

std::vector<Relation> findRelations(const mapper::State& state, const RelationsOptions& options,
                                    const KnownRelations& known) {
  return Finder(state, options, known).find();
}

}  // namespace omnimapper::plugins
