#include "LandmarkRelocations.h"

#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/graph/Linearized.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/landmarks/Fit.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>

#include <algorithm>
#include <map>

namespace omnimapper::plugins {

namespace {

const graph::SolveOptions kVisitSolve{graph::SolveOptions::Method::levenberg_marquardt, 30, 1e-6, {}};

// A landmark with the factors that bind it alone and some of its measurements; all other variables are fixed.
class Visit {
 public:
  Visit(const WeighedLandmark& landmark, const graph::Graph& graph) : landmark_(&landmark), whole_(&graph) {
    for (const auto id : landmark.variables) {
      const auto& variable = graph.variable(id);
      own_[id] = held_.addVariable(variable.kind, variable.value);
    }
    for (const auto id : factorsOfItself(landmark, graph)) held_.addFactor(bound(graph.factor(id)));
  }

  /// Adds the measurement if it fits; returns whether it did.
  bool add(base::FactorId measurement, double limit) {
    const auto id = held_.addFactor(bound(whole_->factor(measurement)));
    if (!measurements_.empty() && held_.whitenedResidual(id).squaredNorm() > limit) {
      held_.removeFactor(id);
      return false;
    }
    measurements_.push_back(measurement);
    // The landmark is estimated anew each time the number of measurements has doubled.
    if ((measurements_.size() & (measurements_.size() - 1)) == 0) graph::solve(held_, kVisitSolve);
    return true;
  }

  void addAll(const std::vector<base::FactorId>& measurements) {
    for (const auto id : measurements) held_.addFactor(bound(whole_->factor(id)));
    measurements_.insert(measurements_.end(), measurements.begin(), measurements.end());
    graph::solve(held_, kVisitSolve);
  }

  const std::vector<base::FactorId>& measurements() const { return measurements_; }
  std::vector<Eigen::VectorXd> values() const {
    std::vector<Eigen::VectorXd> values;
    for (const auto id : landmark_->variables) values.push_back(held_.value(own_.at(id)));
    return values;
  }

 private:
  graph::FactorRecord bound(graph::FactorRecord record) {
    for (auto& id : record.variables) {
      if (own_.count(id) == 0) own_[id] = held_.addVariable(whole_->variable(id).kind, whole_->value(id), true);
      id = own_.at(id);
    }
    record.weight = 1;
    return record;
  }

  const WeighedLandmark* landmark_;
  const graph::Graph* whole_;
  graph::Graph held_;
  std::map<base::VariableId, base::VariableId> own_;
  std::vector<base::FactorId> measurements_;
};

std::vector<Visit> visitsOf(const WeighedLandmark& landmark, const MeasurementFrames& frames, const map::Map& map,
                            const graph::Graph& graph, const DynamicLandmarksOptions& options) {
  constexpr double kInflation = 9;  // of the gate: within a visit, only a large displacement is detected
  std::map<std::pair<std::size_t, base::FactorId>, const map::KeyFrame*> in_order;
  for (const auto id : landmark.measurements) {
    if (const auto* frame = frames.of(graph.factor(id))) in_order[{map.key_frames.position(frame->id), id}] = frame;
  }
  std::vector<Visit> visits;
  const map::KeyFrame* last = nullptr;
  for (const auto& [place, frame] : in_order) {
    const auto measurement = place.second;
    const double limit =
        kInflation * graph::chiSquareQuantile(options.confidence, graph.factor(measurement).noise.size());
    const bool goes_on = last && last->id.session == frame->id.session &&
                         base::secondsBetween(last->stamp, frame->stamp) <= options.visit_gap;
    if (!goes_on || !visits.back().add(measurement, limit)) {
      visits.emplace_back(landmark, graph);
      visits.back().add(measurement, limit);
    }
    last = frame;
  }
  return visits;
}

// The variables of the landmark for each visit, in a graph in which each visit has its own.
using VisitVariables = std::vector<std::vector<base::VariableId>>;

VisitVariables splitIntoVisits(const WeighedLandmark& landmark, const std::vector<Visit>& visits, graph::Graph& graph) {
  // Relations lose their weight too, because it is unknown to which visit they belong.
  for (const auto variable : landmark.variables) {
    const auto factors = graph.factorsOf(variable);
    for (const auto id : factors) graph.setWeight(id, 0);
  }
  const auto of_itself = factorsOfItself(landmark, graph);
  VisitVariables all;
  for (const Visit& visit : visits) {
    std::map<base::VariableId, base::VariableId> own;
    const auto values = visit.values();
    all.emplace_back();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto id = landmark.variables[i];
      all.back().push_back(graph.addVariable(graph.variable(id).kind, values[i]));
      own[id] = all.back().back();
    }
    const auto copy = [&](base::FactorId factor) {
      graph::FactorRecord record = graph.factor(factor);
      for (auto& id : record.variables)
        if (own.count(id) > 0) id = own.at(id);
      record.weight = 1;
      graph.addFactor(std::move(record));
    };
    for (const auto id : visit.measurements()) copy(id);
    for (const auto id : of_itself) copy(id);
  }
  return all;
}

// Chi-square of the change between the landmark's values of two visits; 0 if its covariance is not positive definite.
double chi2OfMove(const std::vector<base::VariableId>& from, const std::vector<base::VariableId>& to,
                  const graph::Graph& graph, const mapper::Uncertainty& uncertainty) {
  auto ids = from;
  ids.insert(ids.end(), to.begin(), to.end());
  const Eigen::MatrixXd joint = uncertainty.joint(graph, ids).value();
  const Eigen::Index n = joint.rows() / 2;
  plane_factors::PlaneParametrization::Difference move{Eigen::VectorXd(n), Eigen::MatrixXd::Zero(n, 2 * n)};
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto one =
        plane_factors::differenceOf(*graph.variable(from[i]).kind, graph.value(from[i]), graph.value(to[i]));
    const Eigen::Index size = one.change.size();
    move.change.segment(row, size) = one.change;
    move.by_both.block(row, row, size, size) = one.by_both.leftCols(size);
    move.by_both.block(row, n + row, size, size) = one.by_both.rightCols(size);
    row += size;
  }
  const auto fit = landmarks::fitOf(move.change, move.by_both * joint * move.by_both.transpose());
  return fit ? fit->chi2 : 0;
}

std::vector<Eigen::VectorXd> valuesOfVisit(const std::vector<base::VariableId>& variables, const graph::Graph& graph) {
  std::vector<Eigen::VectorXd> values;
  for (const auto id : variables) values.push_back(graph.value(id));
  return values;
}

// Assigns each visit to the place that it fits best, or to a new place if it fits none.
std::vector<MeasuredPlace> placesOfVisits(const map::Landmark& landmark, const std::vector<Visit>& visits,
                                          const VisitVariables& variables, const map::Map& map,
                                          const graph::Graph& graph, const mapper::Uncertainty& uncertainty,
                                          const DynamicLandmarksOptions& options) {
  int rows = 0;
  for (const auto id : variables.front()) rows += graph.variable(id).kind->tangentSize();
  const double limit = graph::chiSquareQuantile(options.confidence, rows);
  std::vector<MeasuredPlace> places;
  std::vector<std::vector<std::size_t>> members;
  // The displacement is computed from the whole surface, because each visit may have seen another part of a wall.
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const auto here = middleOf(landmark, valuesOfVisit(variables[i], graph), map.key_frames);
    double best = limit;
    std::size_t best_place = places.size();
    for (std::size_t p = 0; p < places.size(); ++p) {
      for (const std::size_t other : members[p]) {
        const auto there = middleOf(landmark, valuesOfVisit(variables[other], graph), map.key_frames);
        const bool near = here && there && (*here - *there).norm() < options.min_move;
        const double chi2 = near ? 0 : chi2OfMove(variables[other], variables[i], graph, uncertainty);
        if (chi2 > best) continue;
        best = chi2;
        best_place = p;
      }
    }
    if (best_place == places.size()) {
      places.emplace_back();
      members.emplace_back();
    }
    members[best_place].push_back(i);
    auto& measurements = places[best_place].measurements;
    measurements.insert(measurements.end(), visits[i].measurements().begin(), visits[i].measurements().end());
  }
  return places;
}

}  // namespace

MeasurementFrames::MeasurementFrames(const map::KeyFrames& key_frames) {
  for (const auto& frame : key_frames) of_poses_[frame.pose] = &frame;
}

const map::KeyFrame* MeasurementFrames::of(const graph::FactorRecord& measurement) const {
  for (const auto id : measurement.variables) {
    const auto found = of_poses_.find(id);
    if (found != of_poses_.end()) return found->second;
  }
  return nullptr;
}

std::optional<std::vector<std::vector<MeasuredPlace>>> clusterMeasurements(
    const map::Map& map, const graph::Graph& graph, const std::vector<WeighedLandmark>& landmarks,
    const DynamicLandmarksOptions& options) {
  const MeasurementFrames frames(map.key_frames);
  graph::Graph copy = graph;
  std::vector<std::vector<Visit>> visits;
  std::vector<VisitVariables> variables;
  for (const auto& landmark : landmarks) {
    visits.push_back(visitsOf(landmark, frames, map, graph, options));
    variables.push_back(splitIntoVisits(landmark, visits.back(), copy));
  }
  graph::solve(copy, kVisitSolve);
  const mapper::Uncertainty uncertainty(copy);
  if (!uncertainty.joint(copy, {map.key_frames.back().pose})) return std::nullopt;
  std::vector<std::vector<MeasuredPlace>> places;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    places.push_back(visits[i].empty() ? std::vector<MeasuredPlace>()
                                       : placesOfVisits(map.landmark(landmarks[i].id), visits[i], variables[i], map,
                                                        copy, uncertainty, options));
  }
  return places;
}

std::vector<Eigen::VectorXd> valuesSeenBy(const std::vector<base::FactorId>& measurements,
                                          const WeighedLandmark& landmark, const graph::Graph& graph) {
  Visit visit(landmark, graph);
  visit.addAll(measurements);
  return visit.values();
}

bool isDetermined(const WeighedLandmark& landmark, const std::vector<base::FactorId>& measurements,
                  const graph::Graph& graph) {
  constexpr double kLeast = 1e-9;  // of the information in the best known direction
  auto factors = factorsOfItself(landmark, graph);
  factors.insert(factors.end(), measurements.begin(), measurements.end());
  std::map<base::VariableId, Eigen::Index> offsets;
  Eigen::Index size = 0;
  for (const auto id : landmark.variables) {
    offsets[id] = size;
    size += graph.variable(id).kind->tangentSize();
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const auto id : factors) {
    const auto& record = graph.factor(id);
    const graph::Linearized linearized(graph, record);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(linearized.residual.size(), size);
    for (std::size_t i = 0; i < record.variables.size(); ++i) {
      const auto offset = offsets.find(record.variables[i]);
      if (offset == offsets.end()) continue;
      jacobian.middleCols(offset->second, linearized.jacobians[i].cols()) = linearized.jacobians[i];
    }
    information += jacobian.transpose() * jacobian;
  }
  const Eigen::VectorXd known = geometry::eigenvaluesOf<Eigen::Dynamic>(information);
  return known.minCoeff() > kLeast * known.maxCoeff();
}

std::optional<Eigen::Vector3d> middleOf(const map::Landmark& landmark, const std::vector<Eigen::VectorXd>& values,
                                        const map::KeyFrames& key_frames, const std::set<base::KeyFrameId>& seen_from) {
  if (!landmark.payload) return std::nullopt;
  auto payload = landmark.payload->seenFrom(seen_from);
  if (!payload) payload = landmark.payload;
  const auto shape = payload->shape(values, key_frames);
  auto points = shape.points;
  for (const auto& surface : shape.surfaces)
    points.insert(points.end(), surface.vertices.begin(), surface.vertices.end());
  for (const auto& [from, to] : shape.lines) points.insert(points.end(), {from, to});
  if (points.empty()) return std::nullopt;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : points) middle += point / static_cast<double>(points.size());
  return middle;
}

}  // namespace omnimapper::plugins
