#pragma once

#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/State.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "RelationsPlugin.h"

namespace omnimapper::plugins {

/// The kind of a relation's factor, and the two variables of the factor, the one with the smaller id first.
using RelatedPair = std::pair<std::string, std::pair<base::VariableId, base::VariableId>>;

/// Relations that were found before, and whether the consistency test has accepted them.
using KnownRelations = std::map<RelatedPair, bool>;

/// A relation that is likelier than not.
struct Relation {
  RelatedPair pair;
  graph::FactorRecord record;
  std::string name;  ///< "point on wall"
  double chi2 = 0, likelihood_ratio = 0;
};

/// Finds relations between the landmarks of a map that are likelier than not, beside the `known` ones (thesis 4.5.1).
/// For each possible relation of two landmarks, two likelihoods of the residual are compared: that if the relation
/// holds, by the covariance of both landmarks, and that if it does not hold and the residual may be anywhere in its
/// range. A point gets at most one relation, and the relations of directions and of lines form trees: n parallel walls
/// get n - 1 relations, not one for each pair (RelationClosure). Landmarks of a session that is not aligned are related
/// only to each other. The likeliest relation is first.
std::vector<Relation> findRelations(const mapper::State& state, const RelationsOptions& options,
                                    const KnownRelations& known);

}  // namespace omnimapper::plugins
