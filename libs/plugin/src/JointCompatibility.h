#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// A pairing as rows of the joint innovation.
struct PairingRows {
  std::size_t measurement, landmark;  ///< their indices
  Eigen::Index first, size;           ///< its rows
  double chi2, limit;                 ///< of this pairing alone
  double cost;                        ///< chi2 + log |covariance|
};

/// The innovation of all pairings, whitened by the noise of each, so that the covariance of any pairing given others is
/// at least the identity.
struct JointInnovation {
  std::vector<PairingRows> pairings;
  Eigen::VectorXd residual;
  Eigen::MatrixXd covariance;
  bool repeats = false;  ///< several measurements may match the same landmark

  /// For each measurement, the pairings that pass their own gate, the lowest cost first.
  std::vector<std::vector<std::size_t>> byMeasurement(std::size_t measurements) const;
};

struct SearchOptions {
  double confidence;
  double margin;  ///< rivals that cost more than the best by more than this are ignored
  int max_nodes;
};

/// The interpretation with the lowest cost: chi2 and log |covariance| of all matches jointly, and for each unmatched
/// measurement the cost of its likeliest pairing at the limit of the gate.
struct Interpretation {
  std::vector<std::optional<std::size_t>> pairing_of;  ///< by measurement; none if it is not matched
  double chi2 = 0;
  Eigen::Index rows = 0;
  struct Rival {
    std::size_t pairing;
    double dearer;  ///< by how much the best interpretation with it costs more than the best one
  };
  std::vector<std::optional<Rival>> rival_of;  ///< by measurement: its best other landmark, within the margin
  int nodes = 0;
  bool complete = true;
};

/// Joint compatibility branch and bound (Neira and Tardos, Data Association in Stochastic Mapping Using the Joint
/// Compatibility Test, TRA 2001), where the Cholesky factor of the joint innovation grows by a block for each pairing.
Interpretation searchJointly(const JointInnovation& innovation, std::size_t measurements, const SearchOptions& options);

/// Assigns the best fits first, each pairing by itself.
Interpretation matchNearest(const JointInnovation& innovation, std::size_t measurements);

/// The chi-square quantile of `confidence` for a residual of `rows` rows. Results for the last confidence are kept.
double chi2Limit(double confidence, Eigen::Index rows);

}  // namespace omnimapper::mapper
