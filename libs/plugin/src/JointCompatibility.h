#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// A pairing as rows of one joint innovation.
struct PairingRows {
  std::size_t measurement, landmark;  ///< numbers
  Eigen::Index first, size;           ///< its rows
  double chi2, limit;                 ///< of it alone
  double cost;                        ///< chi2 + log |covariance|
};

/// The innovation of all pairings: whitened by the noise of each, so that no covariance of one given others is smaller
/// than the identity.
struct JointInnovation {
  std::vector<PairingRows> pairings;
  Eigen::VectorXd residual;
  Eigen::MatrixXd covariance;
  bool repeats = false;  ///< a landmark may be met by several measurements

  /// Of measurement m: the pairings that pass their own gate, cheapest first.
  std::vector<std::vector<std::size_t>> byMeasurement(std::size_t measurements) const;
};

struct SearchOptions {
  double confidence;
  double margin;  ///< of the cost: rivals that are dearer are of no interest
  int max_nodes;
};

/// The interpretation of least cost: sum of chi2 and log |covariance| of what is matched, jointly, and the limit of
/// each measurement that is not.
struct Interpretation {
  std::vector<std::optional<std::size_t>> pairing_of;  ///< measurement
  double chi2 = 0;
  Eigen::Index rows = 0;
  struct Rival {
    std::size_t pairing;
    double dearer;  ///< cost of the best interpretation with it, over that of the best
  };
  std::vector<std::optional<Rival>> rival_of;  ///< cheapest other landmark of a measurement, within the margin
  int nodes = 0;
  bool complete = true;
};

/// Joint compatibility branch and bound (Neira and Tardos, Data Association in Stochastic Mapping Using the Joint
/// Compatibility Test, TRA 2001), with the joint innovation's Cholesky factor growing by a block for each pairing.
Interpretation searchJointly(const JointInnovation& innovation, std::size_t measurements, const SearchOptions& options);

/// Best fits first, each by itself.
Interpretation matchNearest(const JointInnovation& innovation, std::size_t measurements);

/// Chi-square that a residual of so many rows stays below with that probability; the last few answers are kept.
double chi2Limit(double confidence, Eigen::Index rows);

}  // namespace omnimapper::mapper
