#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/mapper/RelativeUncertainty.h>

#include <Eigen/LU>
#include <algorithm>

namespace omnimapper::mapper {

namespace {

using geometry::Matrix6d;

Matrix6d ofMarginals(const graph::Marginals& marginals, const map::KeyFrame& from, const map::KeyFrame& to) {
  const auto from_from_to = geometry::fromMrpt(to.map_from_base - from.map_from_base);
  const Eigen::MatrixXd joint = marginals.jointCovariance({from.pose, to.pose});
  if (joint.rows() == 6) {
    return geometry::embedPlanar(geometry::betweenCovariance(geometry::project(from_from_to), Matrix6d(joint)));
  }
  return geometry::betweenCovariance(from_from_to, Eigen::Matrix<double, 12, 12>(joint));
}

// Of one key frame from the one before, by the factors between just these two, as if each measured the motion itself.
Matrix6d ofStep(const graph::Graph& graph, const map::KeyFrame& from, const map::KeyFrame& to) {
  const int size = graph.variable(to.pose).kind->tangentSize();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const auto id : graph.factorsOf(to.pose)) {
    const auto& record = graph.factor(id);
    const bool binds_both = record.variables == std::vector<base::VariableId>{from.pose, to.pose};
    if (binds_both && record.noise.size() == size) information += record.weight * record.noise.information();
  }
  const Eigen::MatrixXd covariance = information.inverse();
  return size == 3 ? geometry::embedPlanar(Eigen::Matrix3d(covariance)) : Matrix6d(covariance);
}

}  // namespace

bool RelativeUncertainty::update(const View& view) {
  if (marginals_ && solves_ == view.counts.solves) return true;
  try {
    marginals_.emplace(view.graph);
  } catch (const base::Error&) {
    marginals_.reset();
    return false;
  }
  solves_ = view.counts.solves;
  covered_ = view.map.key_frames.size();
  return true;
}

std::optional<Matrix6d> RelativeUncertainty::between(const View& view, base::KeyFrameId from, base::KeyFrameId to) {
  if (!update(view)) return std::nullopt;
  const auto& frames = view.map.key_frames;
  const auto indexOf = [&](base::KeyFrameId id) {
    return static_cast<std::size_t>(&view.map.keyFrame(id) - frames.data());
  };
  const std::size_t first = indexOf(from), last = indexOf(to);
  const std::size_t anchor = std::min(last, covered_ - 1);
  Matrix6d covariance = first < anchor ? ofMarginals(*marginals_, frames[first], frames[anchor]) : Matrix6d::Zero();
  for (std::size_t i = std::max(first, anchor) + 1; i <= last; ++i) {
    const auto step = geometry::fromMrpt(frames[i].map_from_base - frames[i - 1].map_from_base);
    covariance = geometry::composeCovariance(covariance, step, ofStep(view.graph, frames[i - 1], frames[i]));
  }
  return covariance;
}

}  // namespace omnimapper::mapper
