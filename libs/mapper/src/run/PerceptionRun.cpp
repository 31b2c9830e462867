#include <omnimapper/base/Numbers.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PerceptionRun.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/plugin/StageTimes.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/ReadAhead.h>
#include <omnimapper/source/openLogs.h>

#include <sstream>

#include "run/PerceivedLog.h"
#include "run/PerceptionLine.h"
#include "run/SourceWarnings.h"

namespace omnimapper::mapper {

namespace {

using mrpt::obs::CObservation;

// Returns true if it was stopped.
bool work(source::ObservationSource& log, const SensorPoses& sensor_poses, PerceptionLine& line, PerceivedLog& output,
          base::Progress& progress, const std::function<bool()>& stop) {
  bool stopped = false;
  while (!(stopped = stop())) {
    const auto observation = log.next();
    if (!observation) break;
    if (line.isFull()) output.add(line.take());
    line.add(sensor_poses.applied(observation));
    progress.report(log.progress(), "perceiving");
  }
  while (!line.isEmpty()) output.add(line.take());
  return stopped || (log.report().ending == source::SourceReport::Ending::open && stop());
}

// Throws if nothing was derived, so that the output of an earlier run is not replaced by an empty file.
void refuseNothing(const PerceptionRequest& request, const std::string& ini, const PerceptionResult& result) {
  for (const auto& extractor : result.extractors) {
    if (extractor.taken > 0) return;
  }
  std::string logs;
  for (const auto& log : request.logs) logs += (logs.empty() ? "" : ", ") + log;
  throw base::Error(result.code == base::ExitCode::ok ? base::ExitCode::nothing_to_map : result.code,
                    logs + ": contains no observation from which an extractor of " + ini +
                        " derives anything; nothing was written.\nWhat was read:\n" + result.source.text());
}

}  // namespace

PerceptionResult runPerception(const PerceptionRequest& request, const base::Config& config, base::Progress& progress,
                               const std::function<bool()>& stop) {
  const StopWatch watch;
  loadPluginLibraries(config);
  const auto options = config.section("perception").read<PerceptionOptions>();
  const auto settings = EngineSettings::read(config);
  const auto source_options = sourceOptions(config);
  if (options.extractors.empty()) {
    throw base::Error(base::ExitCode::out_of_range,
                      config.placeOf("perception", "extractors") +
                          ": [perception] extractors is empty: name the sections of the extractors");
  }
  PluginContext context;
  context.config_text = config.text();
  const auto plugins = makePlugins({{}, options.extractors, {}, {}}, config, context);
  const SensorPoses sensor_poses(settings.engine.sensors, config);
  config.refuseUnreadSections();
  PerceptionResult result;
  for (const auto& [section, extractor] : plugins.extractors) result.extractors.push_back({section});
  source::ReadAhead log(source::openLogs(request.logs, source_options, stop), stop);
  source::writeRawlog(request.output, [&](source::RawlogWriter& rawlog) {
    PerceptionLine line(plugins.extractors, std::max(1, request.threads));
    PerceivedLog output(request, rawlog, result);
    const bool stopped = work(log, sensor_poses, line, output, progress, stop);
    result.source = log.report();
    result.code = stopped ? base::ExitCode::interrupted : result.source.exitCode();
    output.finish();
    refuseNothing(request, config.file(), result);
  });
  for (auto& warning : warningsOf(result.source)) result.warnings.push_back(std::move(warning));
  for (const auto& [section, extractor] : plugins.extractors) {
    for (const auto& warning : extractor->warnings()) result.warnings.push_back("[" + section + "] " + warning);
  }
  if (result.code == base::ExitCode::interrupted)
    result.warnings.push_back("interrupted: the output contains what was derived until then");
  result.wall_seconds = watch.seconds();
  return result;
}

std::string toText(const PerceptionResult& result, const std::string& output) {
  std::ostringstream out;
  for (const auto& extractor : result.extractors) {
    out << "  " << extractor.section << ": " << base::counted(extractor.derived, "observation") << " of "
        << extractor.taken;
    if (extractor.failed > 0) out << ", " << extractor.failed << " left out";
    if (extractor.unchanged > 0)
      out << ", " << extractor.unchanged << " repeated, because the observation showed nothing new";
    out << "\n";
  }
  out << "wall time " << result.wall_seconds << " s\nin " << output << "\n";
  return out.str();
}

}  // namespace omnimapper::mapper
