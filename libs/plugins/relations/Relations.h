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

/// Two variables, the smaller first, with the kind of what relates them.
using RelatedPair = std::pair<std::string, std::pair<base::VariableId, base::VariableId>>;

/// Relations that were found before, and whether the consistency test lets them act.
using KnownRelations = std::map<RelatedPair, bool>;

/// A relation that is likelier than not.
struct Relation {
  RelatedPair pair;
  graph::FactorRecord record;
  std::string name;  ///< "point on wall"
  double chi2 = 0, likelihood_ratio = 0;
};

/// What may be said of the landmarks of a map, beside what is `known` (thesis 4.5.1): each possible relation of two
/// landmarks is weighed by the likelihood of its residual if it holds, by the covariance of both, against that of any
/// residual there is room for. A point gets one relation at most, and directions and lines a tree each: what many share
/// is told once of each, not once of each pair (RelationClosure). Landmarks of a session that is not joined are related
/// among themselves only. The likeliest first.
std::vector<Relation> findRelations(const mapper::State& state, const RelationsOptions& options,
                                    const KnownRelations& known);

}  // namespace omnimapper::plugins
