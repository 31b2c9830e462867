#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <Eigen/Cholesky>

namespace omnimapper::mapper {

namespace {

using geometry::Matrix6d;

Matrix6d withFloor(Matrix6d covariance) {
  constexpr double kPosition = 1e-4, kAngle = 0.001 * 3.14159265358979323846 / 180;
  for (int i = 0; i < 6; ++i) {
    const double floor = i < 3 ? kPosition * kPosition : kAngle * kAngle;
    if (covariance(i, i) < floor) covariance(i, i) = floor;
  }
  // A reported matrix may not be a valid covariance, but its diagonal always is.
  if (Eigen::LLT<Matrix6d>(covariance).info() != Eigen::Success) {
    return covariance.diagonal().asDiagonal();
  }
  return covariance;
}

graph::SquareRootInformation noiseOf(Motion motion, const Matrix6d& covariance) {
  const Matrix6d floored = withFloor(covariance);
  return motion == Motion::planar ? graph::SquareRootInformation::fromCovariance(geometry::planarPart(floored))
                                  : graph::SquareRootInformation::fromCovariance(floored);
}

}  // namespace

std::shared_ptr<const graph::Variable> poseVariable(Motion motion) {
  return motion == Motion::planar ? graph::se2() : graph::se3();
}

Eigen::VectorXd poseValue(Motion motion, const mrpt::poses::CPose3D& map_from_base) {
  const auto pose = geometry::fromMrpt(map_from_base);
  if (motion == Motion::planar) return graph::toValue(geometry::project(pose));
  return graph::toValue(pose);
}

mrpt::poses::CPose3D poseOf(const graph::Graph& graph, base::VariableId id) {
  const auto& record = graph.variable(id);
  if (record.kind->kind() == graph::se2()->kind()) {
    return geometry::toMrpt(geometry::lift(graph::se2FromValue(record.value.data())));
  }
  return geometry::toMrpt(graph::se3FromValue(record.value.data()));
}

graph::FactorRecord betweenPoses(Motion motion, base::VariableId begin, base::VariableId end,
                                 const RelativeMotion& measured, const std::string& owner) {
  const auto begin_from_end = geometry::fromMrpt(measured.begin_from_end);
  std::shared_ptr<const graph::Factor> factor;
  if (motion == Motion::planar) {
    factor = std::make_shared<graph::BetweenSe2>(geometry::project(begin_from_end));
  } else {
    factor = std::make_shared<graph::BetweenSe3>(begin_from_end);
  }
  graph::FactorRecord record{{begin, end}, std::move(factor), noiseOf(motion, measured.covariance), {}, 1, {}};
  record.tags.owner = owner;
  return record;
}

graph::FactorRecord posePrior(Motion motion, base::VariableId pose, const mrpt::poses::CPose3D& map_from_base,
                              const Matrix6d& covariance, const std::string& owner) {
  const auto measured = geometry::fromMrpt(map_from_base);
  std::shared_ptr<const graph::Factor> factor;
  if (motion == Motion::planar) {
    factor = std::make_shared<graph::PriorSe2>(geometry::project(measured));
  } else {
    factor = std::make_shared<graph::PriorSe3>(measured);
  }
  graph::FactorRecord record{{pose}, std::move(factor), noiseOf(motion, covariance), {}, 1, {}};
  record.tags.owner = owner;
  return record;
}

}  // namespace omnimapper::mapper
