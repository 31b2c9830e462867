#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/interaction/PointingGesture.h>
#include <omnimapper/interaction/PointingModel.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::interaction {

/// Something that a person may point at, in the frame of the gesture: an object by its points, or a surface by its
/// outline, of which one is empty.
struct PointedCandidate {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  geometry::Polygon3 outline;           ///< [m]
  bool may_be_meant = true;             ///< false: it only hides what is behind it
  double weight = 1;                    ///< how often such a thing is meant, before the gesture, relative to others
  /// Of a surface, an outline around the other in its plane: up to there it goes on, unseen. It may be aimed at there
  /// where nothing else is in the way, and hides nothing. Empty: it ends where its outline does.
  geometry::Polygon3 reach = {};
};

enum class PointingMethod { elbow_hand, head_hand, both };

/// How a target is determined, with the defaults of doc/derivations/pointing.md.
struct TargetOptions {
  PointingMethod method = PointingMethod::both;
  double nothing_prior = 0.02;  ///< probability that none of the candidates is meant, before the gesture is seen
  double freedom = 20;          ///< degrees of freedom of the distribution of errors (Student's t)
  double sure = 0.95;           ///< probability from which on a candidate is the answer
  double max_range = 5;         ///< [m] from the hand to the nearest point of what may be meant
  static const base::OptionTable<TargetOptions>& table();
};

enum class TargetVerdict { this_one, one_of_these, nothing };

struct TargetAnswer {
  TargetVerdict verdict = TargetVerdict::nothing;
  /// For `this_one` the candidate; for `one_of_these` those to ask about, the likeliest first; for `nothing` none.
  std::vector<std::size_t> candidates;
  std::vector<double> probabilities;  ///< of each candidate: 0 for those that may not be meant
  double nothing = 1;                 ///< probability that none of them is meant
};

/// Which candidate a gesture means (thesis 6.1.4, derived anew): the posterior probabilities of all candidates and of
/// "none of these". Each candidate may be aimed at anywhere on what the hand sees of it; what is nearer to the hand
/// hides what is behind it. With the method `both`, a gesture without elbow or head uses the other ray.
TargetAnswer determineTarget(const PointingGesture& gesture, const std::vector<PointedCandidate>& candidates,
                             const PointingModel& model, const TargetOptions& options);

/// The direction of a target as PointingModel has it.
TargetDirection directionOf(const PointingGesture& gesture, const Eigen::Vector3d& target);

/// The errors of the gesture's rays if it means this target, theta as of a right arm. None for a ray whose joint is not
/// known.
struct GestureErrors {
  std::optional<PointingError> elbow_hand, head_hand;
};
GestureErrors errorsOf(const PointingGesture& gesture, const Eigen::Vector3d& target);

/// The rule of the thesis (6.1.4, 6.2.3), for comparison: the least Mahalanobis distance over the points of an object,
/// with a matrix S that holds standard deviations where variances belong, in degrees; candidates farther than
/// `max_distance` are left out, and if the least distance is more than `max_ratio` of the second least, the answer is
/// to ask. If no object is near enough, the answer is the surface nearest to the hand that the ray of the method meets.
/// `both` is taken as elbow_hand. Probabilities are not given.
struct ThesisRule {
  double max_distance = 2, max_ratio = 0.8;  ///< the thesis states no ratio
};
TargetAnswer determineTargetAsThesis(const PointingGesture& gesture, const std::vector<PointedCandidate>& candidates,
                                     const PointingModel& model, PointingMethod method, const ThesisRule& rule = {});

/// The Mahalanobis distance of that rule to a point. With `is_squared` S holds variances, as it should.
double mahalanobis(const PointingGesture& gesture, const Eigen::Vector3d& target, const PointingModel& model,
                   PointingMethod method, bool is_squared);

}  // namespace omnimapper::interaction
