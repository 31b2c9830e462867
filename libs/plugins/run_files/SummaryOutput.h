#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct SummaryOptions {
  static const base::OptionTable<SummaryOptions>& table();
};

/// Writes summary.json: counts, sizes, decisions by reason, cost and times of the run.
class SummaryOutput : public mapper::OutputPlugin {
 public:
  SummaryOutput(const SummaryOptions& options, const mapper::PluginContext& context);
  void finish(const mapper::View& view) override;

 private:
  std::string path_, title_;
};

class SummaryOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(SummaryOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "SummaryOutput"; }
  std::string summary() const override { return "Writes summary.json, the metrics of the run."; }
  const std::vector<base::OptionSpec>& options() const override { return SummaryOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
