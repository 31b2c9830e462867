#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

/// A measurement that may be of a landmark, as the factor it would be if it were. Its variables are in the graph.
struct Pairing {
  std::size_t measurement;  ///< number within what is associated together
  base::LandmarkId landmark;
  graph::FactorRecord record;
};

/// How measurements are told which landmark they are of (thesis 4.2.2.2). The options struct of a plugin that
/// associates derives from this one.
struct AssociationOptions {
  enum class Method {
    nearest,  ///< each measurement the landmark that it fits best, best fits first
    joint     ///< joint compatibility branch and bound (Neira and Tardos, TRA 2001)
  };
  Method method = Method::joint;
  double confidence = 0.999;  ///< a true match passes a gate with this probability
  double inflation = 1;       ///< of the standard deviations of what the map says
  /// An interpretation of all measurements must be so many times likelier than the best one that takes this measurement
  /// for another landmark; else it is left alone. 1: the best is taken. Method::joint only.
  double min_likelihood_ratio = 20;
  int max_nodes = 20000;  ///< of the search; then the best so far is taken

  /// Adds its keys to the table of a struct that derives from it.
  template <class Options>
  static base::OptionTable<Options>& declareIn(base::OptionTable<Options>& table);
};

/// What became of one measurement.
struct Match {
  enum class Kind {
    matched,
    unknown,    ///< fits no landmark that is left: it may be a new one
    ambiguous,  ///< fits several alike: of one of them, nobody can tell which
    untold      ///< nothing is known of how well the map is known: it cannot be told whether it fits
  };
  Kind kind = Kind::unknown;
  std::optional<std::size_t> pairing;  ///< the one it is, of an ambiguous one the likeliest; else the nearest
  double chi2 = 0;                     ///< of that pairing alone
  double limit = 0;                    ///< of chi2
  std::optional<base::LandmarkId> rival;
  double likelihood_ratio = 0;  ///< to the best interpretation with the rival, where there is one

  /// "matched", "none is near", "fits two landmarks alike", with the numbers behind it.
  void tell(Decision& decision) const;
};

/// One interpretation of measurements that were made together.
struct Association {
  std::vector<Match> matches;  ///< of each measurement
  double chi2 = 0;             ///< of all matches together
  double limit = 0;            ///< of chi2
  int nodes = 0;               ///< that the search looked at
  bool complete = true;        ///< the search did not run out of nodes

  /// As Match::tell(), with what is to be said of the search.
  void tell(std::size_t measurement, Decision& decision) const;
};

/// Whether a landmark may be met twice by measurements of one moment.
enum class Repeats { no, yes };

/// Associates `measurements` things that were measured together, of which `pairings` says what each may be. What the
/// map predicts is compared in units of what is not known of it: the covariance of residual i and j is
/// J_i cov J_j^T, plus the noise where i = j. A measurement alone, and all that are matched together, must pass the
/// chi-square gate. Among the interpretations that do, the likeliest is taken, where a measurement that is left
/// unmatched counts like one at its gate. Landmarks that no factor of positive weight binds are none to match. Of the
/// landmarks that pass the gate of a measurement the best 32 are looked at.
Association associate(std::size_t measurements, const std::vector<Pairing>& pairings, const State& state,
                      const AssociationOptions& options, Repeats repeats);

template <class Options>
base::OptionTable<Options>& AssociationOptions::declareIn(base::OptionTable<Options>& table) {
  Method Options::*const method = &AssociationOptions::method;  // a member of the base is none for deduction
  return table
      .choice("association", method, {{"joint", Method::joint}, {"nearest", Method::nearest}},
              "How a measurement finds its landmark: all of a moment together, or each the nearest.")
      .number("association_confidence", &Options::confidence, base::Range{0.5, 0.999999999},
              "A true match passes a gate with this probability.")
      .number("association_inflation", &Options::inflation, base::Range{1, 100},
              "Factor on the standard deviations of what the map says: odometry is surer of itself than it should be.")
      .number("association_min_ratio", &Options::min_likelihood_ratio, base::Range{1, 1e12},
              "A match must be so many times likelier than the same moment with another landmark in its place; else "
              "the measurement is left out. 1 takes the best. For association = joint.")
      .integer("association_max_nodes", &Options::max_nodes, base::Range{1, 1e9},
               "Interpretations looked at at most, for association = joint; then the best so far is taken.");
}

}  // namespace omnimapper::mapper
