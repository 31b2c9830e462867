#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/MatchCloud.h>

namespace omnimapper::matching {

/// What a registration of clouds makes small.
enum class CloudMethod {
  point_to_point,  ///< distances of points (Besl, McKay: A method for registration of 3-D shapes, PAMI 14(2), 1992)
  point_to_plane,  ///< those across the target's surfaces (Chen, Medioni: Object modelling by registration, 1992)
  gicp,            ///< those in standard deviations of both clouds (Segal, Haehnel, Thrun: Generalized-ICP, RSS 2009)
};

struct CloudMatcherOptions {
  CloudMethod method = CloudMethod::gicp;
  double max_distance = 0.1;     ///< [m] of points that may be the same, on the finest level
  double coarse_distance = 0.4;  ///< [m] on the coarsest
  int max_iterations = 50;       ///< on each level
  double tolerance = 1e-4;  ///< [m] [rad] steps below which the last level ends, and a tenth of those that end others
  int coarse_points = 300;  ///< of the source, on the coarsest level; each further one has four times as many
  int max_points = 2000;    ///< on the finest
  double normal_noise = 0.045;  ///< [rad] of surfaces' normals: what these alone seem to fix is left open
  double alike = 30;            ///< points whose errors are alike: so many count as one
  double min_overlap = 0.3;     ///< least share of the source's points that have one of the target's near

  static const base::OptionTable<CloudMatcherOptions>& table();
};

/// What a registration found.
struct CloudMatch {
  geometry::Se3 target_from_source;
  /// Of that in the source's frame, tangent as in geometry::Se3, by the residuals alone. A direction that they leave
  /// open has a variance of kOpen, and is as good as the guess.
  geometry::Matrix6d covariance = kOpen * geometry::Matrix6d::Identity();
  double overlap = 0;       ///< share of the source's points that have one of the target's near, [0, 1]
  double residual = 0;      ///< [m] median distance of those
  int iterations = 0;       ///< on all levels
  int open_directions = 6;  ///< how many the residuals do not fix
  bool fits = false;        ///< enough overlap, of enough points
  bool succeeded = false;   ///< it fits, and no direction is open

  static constexpr double kOpen = 1e4;  ///< [m2], [rad2]
};

/// Registers clouds. Functions may be called from several threads; the same input gives the same bits.
class CloudMatcher {
 public:
  virtual ~CloudMatcher() = default;
  /// `guess`: target_from_source, where the search begins. Throws Error(out_of_range) for clouds without the normals or
  /// covariances that the method needs.
  virtual CloudMatch match(const MatchCloud& target, const MatchCloud& source, const geometry::Se3& guess) const = 0;
};

/// Iterated closest points from coarse to fine: first for few of the source's points, last for many. Gauss-Newton with
/// weights of Student's t, whose scale is found from the residuals.
class IteratedClosestPoints : public CloudMatcher {
 public:
  /// Throws Error(out_of_range) for counts, distances or a tolerance that are not positive, and for `alike` below 1.
  explicit IteratedClosestPoints(const CloudMatcherOptions& options);
  CloudMatch match(const MatchCloud& target, const MatchCloud& source, const geometry::Se3& guess) const override;
  /// What the residuals say of a registration that somebody else found from `guess`.
  CloudMatch judged(const MatchCloud& target, const MatchCloud& source, const geometry::Se3& guess,
                    const geometry::Se3& target_from_source) const;

 private:
  CloudMatcherOptions options_;
};

}  // namespace omnimapper::matching
