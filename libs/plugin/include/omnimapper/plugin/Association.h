#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// A possible association of a measurement with a landmark, with its factor. The factor's variables are in the graph.
struct Pairing {
  std::size_t measurement;  ///< index among the measurements that are associated together
  base::LandmarkId landmark;
  graph::FactorRecord record;
};

/// Data association options (thesis 4.2.2.2). The options struct of a plugin that associates measurements with
/// landmarks derives from this one.
struct AssociationOptions {
  enum class Method {
    nearest,  ///< each measurement gets the landmark it fits best; best fits are assigned first
    joint     ///< joint compatibility branch and bound (Neira and Tardos, TRA 2001)
  };
  Method method = Method::joint;
  double confidence = 0.999;  ///< a true match passes a gate with this probability
  double inflation = 1;       ///< factor on the standard deviations of what the map predicts
  /// The best interpretation must be at least this many times likelier than the best one that gives a measurement
  /// another landmark, or else the match of that measurement is ambiguous. With 1 the best match is taken. Only for
  /// Method::joint.
  double min_likelihood_ratio = 20;
  int max_nodes = 20000;  ///< limit of the search; beyond it the best so far is taken

  /// Adds the keys of this struct to the table of a struct that derives from it.
  template <class Options>
  static base::OptionTable<Options>& declareIn(base::OptionTable<Options>& table);
};

/// The association result of one measurement.
struct Match {
  enum class Kind {
    matched,
    unknown,      ///< fits no landmark that is still free: it may be a new one
    ambiguous,    ///< fits several landmarks about equally well
    undetermined  ///< the covariance of the map is not available, so the gate cannot be computed
  };
  Kind kind = Kind::unknown;
  std::optional<std::size_t> pairing;  ///< the matched pairing; if ambiguous, the likeliest one; else the nearest one
  double chi2 = 0;                     ///< of that pairing alone
  double limit = 0;                    ///< largest chi2 that passes the gate
  std::optional<base::LandmarkId> rival;
  double likelihood_ratio = 0;  ///< of the best interpretation to the best one with the rival, if there is a rival

  /// Writes the result into `decision`: a reason such as "matched" or "none is near", and the numbers behind it.
  void describe(Decision& decision) const;
};

/// One interpretation of measurements that were made together.
struct Association {
  std::vector<Match> matches;  ///< of each measurement
  double chi2 = 0;             ///< of all matches together
  double limit = 0;            ///< largest chi2 that passes the gate
  int nodes = 0;               ///< number of nodes that the search visited
  bool complete = true;        ///< the search did not run out of nodes

  /// As Match::describe(); also notes if the search was cut short.
  void describe(std::size_t measurement, Decision& decision) const;
};

/// Whether several measurements that were made together may match the same landmark.
enum class Repeats { no, yes };

/// Associates measurements that were made together with landmarks. `measurements` is their number, and `pairings` lists
/// the landmarks to which each measurement may belong. Innovations are weighted by their covariance. The covariance of
/// residuals i and j is J_i cov J_j^T, plus the noise if i = j, where J are the residuals' Jacobians and cov is the
/// covariance of the variables. Each matched measurement alone, and all of them jointly, must pass the chi-square gate.
/// The likeliest interpretation that passes is returned; in the comparison, an unmatched measurement counts like a
/// measurement exactly at its gate. Landmarks that no factor of positive weight binds are not matched. For each
/// measurement only the best 32 landmarks that pass its gate are considered.
Association associate(std::size_t measurements, const std::vector<Pairing>& pairings, const State& state,
                      const AssociationOptions& options, Repeats repeats);

template <class Options>
base::OptionTable<Options>& AssociationOptions::declareIn(base::OptionTable<Options>& table) {
  Method Options::*const method = &AssociationOptions::method;  // template deduction needs the pointer to be of Options
  return table
      .choice("association", method, {{"joint", Method::joint}, {"nearest", Method::nearest}},
              "How measurements are assigned to landmarks: all measurements of an observation jointly, or each "
              "measurement separately to its nearest landmark.")
      .number("association_confidence", &Options::confidence, base::Range{0.5, 0.999999999},
              "Probability with which a measurement passes the chi-square gate of its true landmark. A measurement is "
              "assigned only to a landmark whose gate it passes.")
      .number("association_inflation", &Options::inflation, base::Range{1, 100},
              "The standard deviations that the map predicts for measurements are multiplied by this, because odometry "
              "usually reports smaller ones than it should.")
      .number("association_min_ratio", &Options::min_likelihood_ratio, base::Range{1, 1e12},
              "With association = joint, a measurement is used only if the best assignment of all measurements to "
              "landmarks is at least this many times likelier than the best assignment that gives this measurement "
              "another landmark. With 1 the best assignment is always used.")
      .integer("association_max_nodes", &Options::max_nodes, base::Range{1, 1e9},
               "With association = joint, largest number of assignments that are tried. After that, the best one so "
               "far is taken.");
}

}  // namespace omnimapper::mapper
