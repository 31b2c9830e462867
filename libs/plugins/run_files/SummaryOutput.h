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
  static constexpr const char* kName = "SummaryOutput";
  static constexpr const char* kSummary = "Writes summary.json, the metrics of the run.";

  SummaryOutput(const SummaryOptions& options, const mapper::PluginContext& context);
  void finish(const mapper::View& view) override;

 private:
  std::string path_, title_;
};

}  // namespace omnimapper::plugins
