#include "GraphOutput.h"

#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/graph/G2o.h>

IMPLEMENTS_MRPT_OBJECT(GraphOutputFactory, omnimapper::mapper::OutputPluginFactory, omnimapper::plugins)

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

std::unique_ptr<mapper::OutputPlugin> GraphOutputFactory::make(const base::ConfigSection& section,
                                                               const mapper::PluginContext& context) const {
  return std::make_unique<GraphOutput>(section.read<GraphOutputOptions>(mapper::sectionKeysOfEngine()), context);
}

}  // namespace omnimapper::plugins
