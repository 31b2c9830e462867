#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct GraphOutputOptions {
  static const base::OptionTable<GraphOutputOptions>& table();
};

/// Writes graph.g2o: the poses, points and factors that the format knows; the rest is counted in its comments.
class GraphOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "GraphOutput";
  static constexpr const char* kSummary = "Writes graph.g2o, the graph in the format of g2o.";

  GraphOutput(const GraphOutputOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  std::string path_;
};

}  // namespace omnimapper::plugins
