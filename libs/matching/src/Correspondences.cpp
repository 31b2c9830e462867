#include "Correspondences.h"

#include <omnimapper/matching/ScanMatcher.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {
using Lane = Eigen::Array4f;
constexpr std::size_t kLane = 4;
}  // namespace

double LineEquations::wallDistance() const {
  return weight > 0 ? std::sqrt(squared_distance / weight) : 0;
}

Correspondences::Correspondences(const PointIndex& reference, const ScanWithNormals& scan)
    : reference_(reference), scan_(scan), likely_(scan.size(), PointIndex::kNone) {
  const std::size_t room = (scan.size() + kLane - 1) / kLane * kLane;
  for (Values* values : {&px_, &py_, &qx_, &qy_, &nx_, &ny_, &on_line_, &on_point_}) values->resize(room);
}

void Correspondences::find(const TPose2D& pose, double max_distance) {
  const auto c = static_cast<float>(std::cos(pose.phi)), s = static_cast<float>(std::sin(pose.phi));
  const auto tx = static_cast<float>(pose.x), ty = static_cast<float>(pose.y);
  const auto limit = static_cast<float>(max_distance);
  count_ = 0;
  index_.clear();
  int before = PointIndex::kNone;
  for (std::size_t i = 0; i < scan_.size(); ++i) {
    const auto& p = scan_.points[i];
    const int nearest = reference_.nearest(tx + c * p.x() - s * p.y(), ty + s * p.x() + c * p.y(), limit,
                                           likely_[i] != PointIndex::kNone ? likely_[i] : before);
    likely_[i] = before = nearest;
    if (nearest == PointIndex::kNone) continue;
    px_[count_] = p.x();
    py_[count_] = p.y();
    qx_[count_] = reference_.xs()[nearest];
    qy_[count_] = reference_.ys()[nearest];
    const float nx = nx_[count_] = reference_.normalXs()[nearest];
    const float ny = ny_[count_] = reference_.normalYs()[nearest];
    const bool has_line = nx != 0 || ny != 0;
    const float weight = weighed_ ? scan_.weights[i] : 1;
    on_line_[count_] = has_line ? weight : 0;
    on_point_[count_] = has_line ? 0 : weight;
    index_.push_back(i);
    ++count_;
  }
  for (std::size_t i = count_; i % kLane != 0; ++i) {
    for (Values* values : {&px_, &py_, &qx_, &qy_, &nx_, &ny_, &on_line_, &on_point_}) (*values)[i] = 0;
  }
}

bool Correspondences::weighPoints() {
  const auto& weights = scan_.weights;
  if (std::none_of(weights.begin(), weights.end(), [](float weight) { return weight < 1; })) return false;
  weighed_ = true;
  for (std::size_t k = 0; k < count_; ++k) {
    const float weight = weights[index_[k]];
    on_line_[k] = on_line_[k] > 0 ? weight : 0;
    on_point_[k] = on_point_[k] > 0 ? weight : 0;
  }
  return true;
}

double Correspondences::quantile(const TPose2D& pose, double share) const {
  const auto c = static_cast<float>(std::cos(pose.phi)), s = static_cast<float>(std::sin(pose.phi));
  const auto tx = static_cast<float>(pose.x), ty = static_cast<float>(pose.y);
  scratch_.clear();
  for (std::size_t i = 0; i < count_; ++i) {
    if (on_line_[i] == 0) continue;
    const float dx = tx + c * px_[i] - s * py_[i] - qx_[i], dy = ty + s * px_[i] + c * py_[i] - qy_[i];
    scratch_.push_back(std::abs(nx_[i] * dx + ny_[i] * dy));
  }
  if (scratch_.empty()) return 0;
  const auto place = scratch_.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(scratch_.size() - 1));
  std::nth_element(scratch_.begin(), place, scratch_.end());
  return *place;
}

// Sums are taken in the reference's frame about the scan's origin, then rotated into the scan's frame.
LineEquations Correspondences::equations(const TPose2D& pose, double loss_scale, double point_weight,
                                         double along) const {
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  const auto cf = static_cast<float>(c), sf = static_cast<float>(s);
  const auto tx = static_cast<float>(pose.x), ty = static_cast<float>(pose.y);
  const auto scale = static_cast<float>(1 / (loss_scale * loss_scale)), held = static_cast<float>(point_weight),
             pulled = static_cast<float>(along);
  Lane xx = Lane::Zero(), xy = xx, yy = xx, xt = xx, yt = xx, tt = xx, gx = xx, gy = xx, gt = xx, squares = xx,
       weights = xx, radii = xx;
  for (std::size_t i = 0; i < count_; i += kLane) {
    const auto load = [i](const Values& values) { return Eigen::Map<const Lane>(values.data() + i); };
    const Lane x = cf * load(px_) - sf * load(py_), y = sf * load(px_) + cf * load(py_);
    const Lane dx = x + tx - load(qx_), dy = y + ty - load(qy_), nx = load(nx_), ny = load(ny_);
    const Lane across = nx * dx + ny * dy, lever = x * ny - y * nx;
    const Lane distance = dx * dx + dy * dy, square = across * across;
    const Lane weight = load(on_line_) / (1 + square * scale);
    const Lane point = (held * load(on_point_) + pulled * load(on_line_)) / (1 + distance * scale);
    const Lane wx = weight * nx, wy = weight * ny, wt = weight * lever, wa = weight * across;
    xx += wx * nx + point;
    xy += wx * ny;
    yy += wy * ny + point;
    xt += wx * lever - point * y;
    yt += wy * lever + point * x;
    tt += wt * lever + point * (x * x + y * y);
    gx += wa * nx + point * dx;
    gy += wa * ny + point * dy;
    gt += wa * lever + point * (x * dy - y * dx);
    squares += weight * square;
    weights += weight;
    radii += (weight + point) * (x * x + y * y);
  }
  LineEquations sums;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << c, -s, s, c;
  Eigen::Matrix3d information;
  information << xx.sum(), xy.sum(), xt.sum(), xy.sum(), yy.sum(), yt.sum(), xt.sum(), yt.sum(), tt.sum();
  sums.information = turn.transpose() * information * turn;
  sums.gradient = turn.transpose() * Eigen::Vector3d(gx.sum(), gy.sum(), gt.sum());
  sums.squared_distance = squares.sum();
  sums.weight = weights.sum();
  sums.squared_radius = radii.sum();
  return sums;
}

// Yaw is scaled by the lever at which it moves the points, so that all three are in metres.
ObservableSubspace::ObservableSubspace(const LineEquations& equations, double noise_share) {
  const double total = equations.information.topLeftCorner<2, 2>().trace();
  if (!(total > 0)) {
    basis_.setIdentity();
    information_.setZero();
    return;
  }
  const double lever = std::max(0.5, std::sqrt(equations.squared_radius / total));
  const Eigen::Vector3d scale(1, 1, 1 / lever);
  const Eigen::Matrix3d scaled = scale.asDiagonal() * equations.information * scale.asDiagonal();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scaled);
  basis_ = scale.asDiagonal() * eigen.eigenvectors();
  for (int i = 0; i < 3; ++i) {
    const double value = eigen.eigenvalues()[i];
    const bool is_observable = value > noise_share * total && value > 1e-6;
    information_[i] = is_observable ? value : 0;
    count_ += is_observable;
  }
}

Eigen::Vector3d ObservableSubspace::step(const LineEquations& equations, const Eigen::Matrix3d& guess_information,
                                         const Eigen::Vector3d& from_guess) const {
  constexpr double kNothing = 1e-9;
  const Eigen::Array3d counts = (information_.array() > 0).cast<double>();
  const Eigen::Matrix3d observable_basis = basis_ * counts.matrix().asDiagonal();
  const Eigen::Vector3d slope =
      observable_basis.transpose() * equations.gradient + basis_.transpose() * (guess_information * from_guess);
  Eigen::Matrix3d information = observable_basis.transpose() * equations.information * observable_basis +
                                basis_.transpose() * guess_information * basis_;
  information.diagonal().array() += kNothing;
  return -basis_ * information.ldlt().solve(slope);
}

Eigen::Vector3d ObservableSubspace::observablePart(const Eigen::Vector3d& motion) const {
  const Eigen::Array3d counts = (information_.array() > 0).cast<double>();
  return basis_ * (counts * (basis_.inverse() * motion).array()).matrix();
}

Eigen::Matrix3d ObservableSubspace::covariance() const {
  Eigen::Vector3d variance;
  for (int i = 0; i < 3; ++i) variance[i] = information_[i] > 0 ? 1 / information_[i] : ScanMatch::kOpen;
  return basis_ * variance.asDiagonal() * basis_.transpose();
}

}  // namespace omnimapper::matching
