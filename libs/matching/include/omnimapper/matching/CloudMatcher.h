#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/MatchCloud.h>

namespace omnimapper::matching {

/// Residual that a registration of clouds minimizes.
enum class CloudMethod {
  point_to_point,  ///< distances of points (Besl, McKay: A method for registration of 3-D shapes, PAMI 14(2), 1992)
  point_to_plane,  ///< distances along the target's normals (Chen, Medioni: Object modelling by registration, 1992)
  gicp,  ///< distances in standard deviations of both points (Segal, Haehnel, Thrun: Generalized-ICP, RSS 2009)
};

struct CloudMatcherOptions {
  CloudMethod method = CloudMethod::gicp;
  double max_distance = 0.1;     ///< [m] largest distance of corresponding points on the finest level
  double coarse_distance = 0.4;  ///< [m] largest distance of corresponding points on the coarsest level
  int max_iterations = 50;       ///< on each level
  /// [m] [rad] The finest level ends once a step is shorter than this, the other levels once it is shorter than ten
  /// times this.
  double tolerance = 1e-4;
  int coarse_points = 300;  ///< points of the source on the coarsest level; each finer level has four times as many
  int max_points = 2000;    ///< points of the source on the finest level
  /// [rad] Standard deviation of normals. A direction that would not be constrained if the normals had no noise is left
  /// open.
  double normal_noise = 0.045;
  double alike = 30;         ///< number of points that count as one, because neighbours have similar errors
  double min_overlap = 0.3;  ///< smallest share of the source's points that must have a target point nearby

  static const base::OptionTable<CloudMatcherOptions>& table();
};

/// Result of a registration.
struct CloudMatch {
  geometry::Se3 target_from_source;
  /// Covariance of target_from_source, in the source's frame, with the tangent of geometry::Se3, from the residuals
  /// alone. A direction that the residuals do not constrain is open: its variance is kOpen, and along it the pose stays
  /// at the guess.
  geometry::Matrix6d covariance = kOpen * geometry::Matrix6d::Identity();
  double overlap = 0;       ///< share of the source's points that have a target point nearby, [0, 1]
  double residual = 0;      ///< [m] median distance of paired points
  int iterations = 0;       ///< on all levels together
  int open_directions = 6;  ///< number of directions that the residuals do not constrain
  bool fits = false;        ///< there are enough points and they overlap enough
  bool succeeded = false;   ///< it fits, and no direction is open

  static constexpr double kOpen = 1e4;  ///< [m2], [rad2]
};

/// Registers clouds. Functions may be called from several threads; the same input gives exactly the same result.
class CloudMatcher {
 public:
  virtual ~CloudMatcher() = default;
  /// `guess`: target_from_source, where the search begins. Throws Error(out_of_range) for clouds without the normals or
  /// covariances that the method needs.
  virtual CloudMatch match(const MatchCloud& target, const MatchCloud& source, const geometry::Se3& guess) const = 0;
};

/// Iterated closest points from coarse to fine: coarse levels use few of the source's points, fine levels many.
/// Gauss-Newton with robust weights by Student's t distribution, whose scale is estimated from the residuals.
class IteratedClosestPoints : public CloudMatcher {
 public:
  /// Throws Error(out_of_range) for counts, distances or a tolerance that are not positive, and for `alike` below 1.
  explicit IteratedClosestPoints(const CloudMatcherOptions& options);
  CloudMatch match(const MatchCloud& target, const MatchCloud& source, const geometry::Se3& guess) const override;
  /// Evaluates a registration that another algorithm found from `guess`: its overlap, residuals and covariance.
  CloudMatch judged(const MatchCloud& target, const MatchCloud& source, const geometry::Se3& guess,
                    const geometry::Se3& target_from_source) const;

 private:
  CloudMatcherOptions options_;
};

}  // namespace omnimapper::matching
