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
  GraphOutput(const GraphOutputOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  std::string path_;
};

class GraphOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(GraphOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "GraphOutput"; }
  std::string summary() const override { return "Writes graph.g2o, the graph in the format of g2o."; }
  const std::vector<base::OptionSpec>& options() const override { return GraphOutputOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
