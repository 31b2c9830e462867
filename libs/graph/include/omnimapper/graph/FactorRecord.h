#pragma once

#include <omnimapper/base/Id.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "omnimapper/graph/Factor.h"
#include "omnimapper/graph/Loss.h"
#include "omnimapper/graph/Noise.h"

namespace omnimapper::graph {

/// Labels of a factor for the code that added it and for reports; the solver does not use them.
struct Tags {
  std::string owner;                         ///< name of the plugin that added the factor
  std::optional<base::LandmarkId> landmark;  ///< the landmark that the factor describes
  bool hypothesis = false;                   ///< true if the factor may be wrong and would then distort the map
  std::string note;                          ///< for reports
};

/// A factor in a graph: which variables it binds and how much it counts. The factor adds 1/2 weight loss(|noise *
/// residual|^2) to the cost.
struct FactorRecord {
  std::vector<base::VariableId> variables;
  std::shared_ptr<const Factor> factor;
  SquareRootInformation noise;
  Loss loss = {};
  double weight = 1;  ///< >= 0; with 0 the factor has no influence, but stays in the graph
  Tags tags = {};
};

}  // namespace omnimapper::graph
