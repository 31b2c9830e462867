#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/FixedOffset.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::eval {

namespace {

using geometry::Se3;
using geometry::Vector6d;
using Vector13d = Eigen::Matrix<double, 13, 1>;
using Matrix13d = Eigen::Matrix<double, 13, 13>;

constexpr double kLever = 0.3;  // [m] by which rotation errors count
constexpr int kFewest = 10;     // poses
constexpr double kKept = 0.9;   // share of the poses within the reference at first that a shift of the clock must keep

// The unknowns. A pose's change is in its tangent.
struct Guess {
  Se3 reference_from_estimate;
  FixedOffset offset;
  Guess plus(const Vector13d& step) const {
    return {geometry::plus(reference_from_estimate, step.head<6>()),
            {geometry::plus(offset.body_from_part, step.segment<6>(6)), offset.clock + step[12]}};
  }
};

class Fit {
 public:
  Fit(const Trajectory& estimate, const Trajectory& reference, base::Duration longest_gap)
      : estimate_(estimate), reference_(reference), longest_gap_(longest_gap), first_(posesWithin(0).size()) {}

  // Of the poses that lie within the reference at the guess's clock.
  std::vector<std::size_t> posesWithin(double clock) const {
    std::vector<std::size_t> poses;
    for (std::size_t i = 0; i < estimate_.size(); ++i)
      if (referenceAt(i, clock)) poses.push_back(i);
    return poses;
  }
  Eigen::VectorXd errors(const Guess& guess, const std::vector<std::size_t>& poses) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * poses.size()));
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const auto reference = referenceAt(poses[k], guess.offset.clock);
      if (!reference) continue;
      const Se3 estimate =
          guess.reference_from_estimate * estimate_[poses[k]].world_from_body * guess.offset.body_from_part;
      const Vector6d error = geometry::minus(estimate, *reference);
      all.segment<6>(static_cast<Eigen::Index>(6 * k)) << error.head<3>(), kLever * error.tail<3>();
    }
    return all;
  }
  // The mean of squared errors, which clocks at which fewer poses have a reference do not lower.
  double cost(const Guess& guess) const {
    const auto poses = posesWithin(guess.offset.clock);
    if (static_cast<double>(poses.size()) < kKept * static_cast<double>(first_))
      return std::numeric_limits<double>::infinity();
    return errors(guess, poses).squaredNorm() / static_cast<double>(poses.size());
  }
  // Levenberg and Marquardt; the damping keeps what is not determined where it is.
  std::pair<Guess, double> solved(Guess guess) const {
    double damping = 1e-3, best = cost(guess);
    for (int iteration = 0; iteration < 60 && damping < 1e6; ++iteration) {
      const auto poses = posesWithin(guess.offset.clock);
      const Eigen::VectorXd before = errors(guess, poses);
      const Eigen::MatrixXd jacobian = jacobianAt(guess, poses, before);
      Matrix13d normal = jacobian.transpose() * jacobian;
      normal.diagonal().array() += damping;
      const Vector13d step = -normal.ldlt().solve(jacobian.transpose() * before);
      const Guess next = guess.plus(step);
      const double next_cost = cost(next);
      if (!(next_cost < best)) {
        damping *= 10;
        continue;
      }
      const bool is_small = best - next_cost < 1e-12 * (1 + next_cost);
      guess = next;
      best = next_cost;
      damping = std::max(1e-9, damping / 10);
      if (is_small) break;
    }
    return {guess, best};
  }

 private:
  std::optional<Se3> referenceAt(std::size_t pose, double clock) const {
    return interpolatedPose(reference_, estimate_[pose].stamp + base::durationFromSeconds(clock), longest_gap_);
  }
  Eigen::MatrixXd jacobianAt(const Guess& guess, const std::vector<std::size_t>& poses,
                             const Eigen::VectorXd& errors_at_guess) const {
    constexpr double kStep = 1e-5;
    Eigen::MatrixXd jacobian(errors_at_guess.size(), 13);
    for (int i = 0; i < 13; ++i)
      jacobian.col(i) = (errors(guess.plus(kStep * Vector13d::Unit(i)), poses) - errors_at_guess) / kStep;
    return jacobian;
  }

  const Trajectory& estimate_;
  const Trajectory& reference_;
  base::Duration longest_gap_;
  std::size_t first_;  // number of poses within the reference before its clock is moved
};

}  // namespace

FixedOffset fitFixedOffset(const Trajectory& estimate, const Trajectory& reference, base::Duration longest_gap) {
  const Fit fit(estimate, reference, longest_gap);
  const auto poses = fit.posesWithin(0);
  if (poses.size() < kFewest)
    throw base::Error(
        base::ExitCode::unreadable_input,
        "fewer than ten poses of the estimate lie within the reference: no fixed offset can be solved for");
  const auto& [stamp, first] = estimate[poses.front()];
  const Se3 first_reference = *interpolatedPose(reference, stamp, longest_gap);
  std::optional<std::pair<Guess, double>> best;
  constexpr int kStarts = 8;  // of the yaw of the part
  for (int i = 0; i < kStarts; ++i) {
    Guess start;
    start.offset.body_from_part = geometry::lift({0, 0, 2 * geometry::kPi * i / kStarts});
    start.reference_from_estimate = first_reference * geometry::inverse(first * start.offset.body_from_part);
    const auto found = fit.solved(start);
    if (!best || found.second < best->second) best = found;
  }
  return best->first.offset;
}

Trajectory withOffset(const Trajectory& estimate, const FixedOffset& offset) {
  Trajectory moved = trajectoryOfPart(estimate, offset.body_from_part);
  for (auto& pose : moved) pose.stamp += base::durationFromSeconds(offset.clock);
  return moved;
}

std::string describe(const FixedOffset& offset) {
  constexpr double kDegrees = 180 / geometry::kPi;
  const auto& place = offset.body_from_part.translation;
  const Eigen::Vector3d turn = kDegrees * geometry::logSo3(offset.body_from_part.rotation);
  return "fixed offset of the reference's part on the body: x " + base::fixed(place.x(), 4) + " y " +
         base::fixed(place.y(), 4) + " z " + base::fixed(place.z(), 4) + " m, rotation vector " +
         base::fixed(turn.x(), 2) + " " + base::fixed(turn.y(), 2) + " " + base::fixed(turn.z(), 2) +
         " deg; the reference's clock is " + base::fixed(std::abs(offset.clock), 4) + " s " +
         (offset.clock < 0 ? "behind" : "ahead") + "\n";
}

}  // namespace omnimapper::eval
