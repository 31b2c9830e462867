#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/derived/PlacesOfMap.h>
#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/derived/ThingsOfMap.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/map/LabelledPlaces.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace omnimapper::derived {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

map::Extent extentOf(const map::LandmarkShape& shape, const Vector3d& position) {
  PlanShape plan = fromAbove(shape);
  map::LandmarkShape holes;
  holes.surfaces = shape.holes;
  map::Extent extent{
      std::move(plan.points), std::move(plan.lines), std::move(plan.areas), fromAbove(holes).areas, 0, 0};
  if (extent.points.empty() && extent.lines.empty() && extent.outlines.empty())
    extent.points.emplace_back(position.head<2>());  // too small to have an outline from above
  const Eigen::AlignedBox3d box = boxOf(shape);
  extent.bottom = box.min().z();
  extent.top = box.max().z();
  return extent;
}

// Derivative of the distance between `point` and a plane or line variable with respect to the variable's tangent.
Eigen::RowVectorXd distanceJacobian(const graph::Variable& kind, const Eigen::VectorXd& value, const Vector3d& point) {
  constexpr double kStep = 1e-6;
  const auto distance = [&](double step, int axis) {
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(kind.tangentSize()), moved(value.size());
    delta[axis] = step;
    kind.plus(value.data(), delta.data(), moved.data());
    const Eigen::VectorXd plane = kind.hyperplane(moved.data());
    const auto directions = plane.size() - 1;
    return plane.head(directions).dot(point.head(directions)) + plane[directions];
  };
  Eigen::RowVectorXd jacobian(kind.tangentSize());
  for (int axis = 0; axis < jacobian.size(); ++axis)
    jacobian[axis] = (distance(kStep, axis) - distance(-kStep, axis)) / (2 * kStep);
  return jacobian;
}

// The tangents of points and poses begin with the position.
int positionSize(const graph::Variable& kind) {
  const std::string_view name = kind.kind();
  return name == "point3" || name == "se3" ? 3 : name == "point2" || name == "se2" ? 2 : 0;
}

void addSigma(const map::Landmark& landmark, const mapper::State& state, map::Place& place) {
  if (landmark.variables.size() != 1 || !state.graph.contains(landmark.variables.front())) return;
  const auto id = landmark.variables.front();
  const graph::Variable& kind = *state.graph.variable(id).kind;
  const Eigen::VectorXd value = state.graph.value(id);
  const bool is_plane = kind.hyperplane(value.data()).size() > 0;
  const int size = positionSize(kind);
  if (!is_plane && size == 0) return;
  const auto covariance = state.jointCovariance({id});
  if (!covariance || !covariance->allFinite()) return;
  double variance = 0;
  if (is_plane) {
    const Eigen::RowVectorXd jacobian = distanceJacobian(kind, value, place.position);
    variance = (jacobian * *covariance * jacobian.transpose()).value();
  } else {
    const Eigen::MatrixXd of_position = covariance->topLeftCorner(size, size);
    variance = geometry::eigenvaluesOf<Eigen::Dynamic>(of_position).maxCoeff();
  }
  if (!(variance >= 0) || !std::isfinite(variance)) return;
  place.sigma = std::sqrt(variance);
  place.sigma_is_along_normal = is_plane;
}

using FramesByPose = std::unordered_map<base::VariableId, const map::KeyFrame*>;

// Mean horizontal direction from the landmark to the poses that measured it. None if it was seen from all around,
// because the directions then largely cancel.
std::optional<Vector3d> seenFrom(const map::Landmark& landmark, const mapper::State& state, const FramesByPose& frames,
                                 const Vector3d& position) {
  constexpr double kOneSided = 0.5;  // smallest length of the mean of unit directions
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const auto factor : state.factorsOf(landmark.id)) {
    for (const auto variable : state.graph.factor(factor).variables) {
      const auto frame = frames.find(variable);
      if (frame == frames.end()) continue;
      const auto& pose = frame->second->map_from_base;
      const Vector2d direction = Vector2d(pose.x(), pose.y()) - position.head<2>();
      if (!(direction.norm() > 0)) continue;
      sum.head<2>() += direction.normalized();
      ++count;
    }
  }
  if (count == 0 || sum.norm() < kOneSided * count) return std::nullopt;
  return sum.normalized();
}

bool allHaveVariables(const map::Landmark& landmark, const graph::Graph& graph) {
  return std::all_of(landmark.variables.begin(), landmark.variables.end(),
                     [&](const auto variable) { return graph.contains(variable); });
}

map::Place placeOf(const ShapedLandmark& shaped, const mapper::State& state, const FramesByPose& frames) {
  const map::Landmark& landmark = *shaped.landmark;
  map::Place place;
  place.id = landmark.id;
  place.label = shaped.shape.label;
  place.caption = shaped.shape.caption;
  const std::string named = landmark.kind + " ";  // "marker 12" is counted as "marker"
  place.kind = place.label.compare(0, named.size(), named) == 0 ? landmark.kind : place.label;
  place.moved = shaped.moved;
  place.seen_by = shaped.shape.seen_by;
  place.properties = shaped.shape.properties;
  place.position = referencePoint(shaped.shape);
  place.extent = extentOf(shaped.shape, place.position);
  if (shaped.shape.normal) place.normal = shaped.shape.normal->normalized();
  place.measurements = landmark.evidence;
  place.first_seen = landmark.first_seen;
  place.last_seen = landmark.last_seen;
  if (allHaveVariables(landmark, state.graph)) {
    place.seen_from = seenFrom(landmark, state, frames, place.position);
    addSigma(landmark, state, place);
  }
  return place;
}

bool isAligned(std::uint16_t session, const map::Map& map) {
  return std::none_of(map.sessions.begin(), map.sessions.end(),
                      [&](const map::Session& each) { return each.number == session && !each.aligned; });
}

map::LabelAnchors anchorsIn(const map::Map& map) {
  return {[&map](base::LandmarkId id) { return map.landmark(id).id; },
          [&map](const map::Label& label) {
            return Vector3d(geometry::fromMrpt(map.keyFrame(label.frame).map_from_base) * label.in_frame);
          }};
}

std::optional<map::LastPose> lastPoseOf(const map::Map& map) {
  std::optional<map::LastPose> last;
  for (const auto& frame : map.key_frames) {
    if (!isAligned(frame.id.session, map)) continue;
    const auto& pose = frame.map_from_base;
    last = {pose.x(), pose.y(), pose.yaw(), frame.stamp, frame.id.session};
  }
  return last;
}

}  // namespace

map::Places placesOf(const mapper::State& state) {
  FramesByPose frames;
  for (const auto& frame : state.map.key_frames) frames[frame.pose] = &frame;
  map::Places places;
  const auto shapes = shapesOf(state);
  for (const auto& shaped : shapes)
    if (shaped.isSomewhere() && isAligned(shaped.landmark->id.session, state.map))
      places.places.push_back(placeOf(shaped, state, frames));
  joinFaces(thingsOf(shapes, state.map), shapes, places.places);
  if (const auto* labels = state.map.layers.find<map::Labels>())
    addLabels(*labels, anchorsIn(state.map), places.places);
  places.last_pose = lastPoseOf(state.map);
  return places;
}

}  // namespace omnimapper::derived
