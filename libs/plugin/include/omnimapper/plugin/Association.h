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
  std::size_t measurement;  ///< its index among the measurements that are associated together
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
  /// Smallest ratio of the likelihood of the best interpretation to that of the best one that gives this measurement
  /// another landmark; below it the match is ambiguous. 1 takes the best. Only for Method::joint.
  double min_likelihood_ratio = 20;
  int max_nodes = 20000;  ///< limit of the search; beyond it the best so far is taken

  /// Adds its keys to the table of a struct that derives from it.
  template <class Options>
  static base::OptionTable<Options>& declareIn(base::OptionTable<Options>& table);
};

/// The association result of one measurement.
struct Match {
  enum class Kind {
    matched,
    unknown,      ///< fits no landmark that is still free: it may be a new one
    ambiguous,    ///< fits several landmarks about equally well
    undetermined  ///< the covariance of the map is not available, so it could not be gated
  };
  Kind kind = Kind::unknown;
  std::optional<std::size_t> pairing;  ///< the matched one; if ambiguous the likeliest; else the nearest
  double chi2 = 0;                     ///< of that pairing alone
  double limit = 0;                    ///< of chi2
  std::optional<base::LandmarkId> rival;
  double likelihood_ratio = 0;  ///< to the best interpretation with the rival, where there is one

  /// Writes the result into `decision`: a reason such as "matched" or "none is near", and the numbers behind it.
  void describe(Decision& decision) const;
};

/// One interpretation of measurements that were made together.
struct Association {
  std::vector<Match> matches;  ///< of each measurement
  double chi2 = 0;             ///< of all matches together
  double limit = 0;            ///< of chi2
  int nodes = 0;               ///< number of nodes that the search visited
  bool complete = true;        ///< the search did not run out of nodes

  /// As Match::describe(); also notes if the search was cut short.
  void describe(std::size_t measurement, Decision& decision) const;
};

/// Whether several measurements that were made together may match the same landmark.
enum class Repeats { no, yes };

/// Associates measurements that were made together with landmarks. `measurements` is their number and `pairings` lists
/// the landmarks that each may be of. Innovations are weighted by their covariance: that of residuals i and j is
/// J_i cov J_j^T, plus the noise if i = j. Each matched measurement alone, and all of them jointly, must pass the
/// chi-square gate. The likeliest interpretation that passes is returned; an unmatched measurement counts in it like
/// one at its gate. Landmarks that no factor of positive weight binds are not matched. For each measurement only the
/// best 32 landmarks that pass its gate are considered.
Association associate(std::size_t measurements, const std::vector<Pairing>& pairings, const State& state,
                      const AssociationOptions& options, Repeats repeats);

template <class Options>
base::OptionTable<Options>& AssociationOptions::declareIn(base::OptionTable<Options>& table) {
  Method Options::*const method = &AssociationOptions::method;  // template deduction needs the pointer to be of Options
  return table
      .choice("association", method, {{"joint", Method::joint}, {"nearest", Method::nearest}},
              "How measurements find their landmarks: all of an observation jointly, or each by itself its nearest "
              "landmark.")
      .number("association_confidence", &Options::confidence, base::Range{0.5, 0.999999999},
              "A true match passes a gate with this probability.")
      .number(
          "association_inflation", &Options::inflation, base::Range{1, 100},
          "Factor on the standard deviations that the map predicts, because odometry usually reports smaller ones than "
          "it should.")
      .number("association_min_ratio", &Options::min_likelihood_ratio, base::Range{1, 1e12},
              "Smallest ratio of the likelihood of the best assignment of measurements to landmarks to that of the "
              "best one that gives this measurement another landmark. Below it the measurement is left out; 1 takes "
              "the best match. Only for association = joint.")
      .integer("association_max_nodes", &Options::max_nodes, base::Range{1, 1e9},
               "Largest number of assignments that are searched for association = joint; beyond it, the best so far is "
               "taken.");
}

}  // namespace omnimapper::mapper
