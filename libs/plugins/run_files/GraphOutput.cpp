#include "GraphOutput.h"

#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/graph/G2o.h>

namespace omnimapper::plugins {

const base::OptionTable<GraphOutputOptions>& GraphOutputOptions::table() {
  static const base::OptionTable<GraphOutputOptions> table;
  return table;
}

GraphOutput::GraphOutput(const GraphOutputOptions&, const mapper::PluginContext& context)
    : path_(derived::outputPath(context, "graph.g2o")) {}

void GraphOutput::finish(const mapper::View& view) {
  graph::writeG2o(view.graph, path_);
}

}  // namespace omnimapper::plugins
