#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/map/SessionFigures.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/SessionAlignment.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/plugin/LandmarkShape.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/ReadAhead.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include "Engine.h"
#include "run/RunWarnings.h"
#include "run/SensorLabels.h"
#include "sessions/MapLoader.h"

namespace omnimapper::mapper {

namespace {

// Sleeps so that the log's time runs `speed` times as fast as the clock on the wall.
class Pace {
 public:
  explicit Pace(double speed) : speed_(speed) {}
  // Returns early if it is to stop.
  void waitFor(base::Stamp stamp, const std::function<bool()>& stop) {
    if (speed_ <= 0 || !base::isValid(stamp)) return;
    if (!first_) first_ = stamp;
    const double due = base::secondsBetween(*first_, stamp) / speed_;
    for (double ahead; (ahead = due - watch_.seconds()) > 0 && !stop();) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(ahead, 0.1)));
    }
  }

 private:
  double speed_;
  std::optional<base::Stamp> first_;
  StopWatch watch_;
};

std::string titleOf(const std::vector<std::string>& logs) {
  std::string title;
  for (const auto& log : logs) title += (title.empty() ? "" : " + ") + std::filesystem::path(log).stem().string();
  return title;
}

// Reads the log into the engine until its end, or until `stop`. True if it was stopped.
bool feed(source::ObservationSource& log, Engine& engine, double speed, base::Progress& progress,
          const std::function<bool()>& stop) {
  Pace pace(speed);
  double reading = 0;
  bool stopped = stop();
  while (!stopped) {
    const StopWatch watch;
    const auto observation = log.next();
    reading += watch.seconds();
    if (!observation) {
      stopped = log.report().ending == source::SourceReport::Ending::open && stop();  // stopped while it waited
      break;
    }
    pace.waitFor(observation->timestamp, stop);
    if ((stopped = stop())) break;
    engine.add(observation);
    progress.report(log.progress(), std::to_string(engine.view().map.key_frames.size()) + " key frames");
  }
  engine.addTime("source", reading);
  return stopped;
}

// What breaks while the log is worked on must not cost the map of what came before it.
std::exception_ptr tried(Engine& engine, const std::function<void()>& work) {
  try {
    work();
    return nullptr;
  } catch (const std::exception& error) {
    engine.warn(std::string("broken off: ") + error.what() + "; this is the map of what came before");
    return std::current_exception();
  }
}

// Sections whose `label` and `labels` are those of sensors.
std::vector<std::string> labelledSections(const EngineOptions& options, const PerceptionOptions& perception) {
  std::vector<std::string> sections = options.sensors;
  for (const auto* names : {&options.pose_plugins, &perception.extractors, &options.measurement_plugins}) {
    sections.insert(sections.end(), names->begin(), names->end());
  }
  return sections;
}

// An empty map is not written: it would take the place of a good one.
[[noreturn]] void failWithNothingToMap(const RunRequest& request, const std::string& ini, const RunResult& result,
                                       const std::vector<std::string>& unknown_labels) {
  std::string logs, labels;
  for (const auto& sentence : unknown_labels) labels += sentence + "\n";
  for (const auto& log : request.logs) logs += (logs.empty() ? "" : ", ") + log;
  const bool is_whole = result.code == base::ExitCode::ok;
  const std::string how = result.code == base::ExitCode::interrupted ? "interrupted before the first" : "no";
  throw base::Error(
      is_whole ? base::ExitCode::nothing_to_map : result.code,
      logs + ": nothing to map: " + how + " observation that a measurement plugin of " + ini + " wants" +
          (is_whole ? " (see its [source], [perception] extractors and [mapper] measurement_plugins)" : "") +
          "; nothing was written.\n" + labels + "What was read:\n" + result.source.text());
}

// What stands still in the map though it moved is wrong by as much.
[[noreturn]] void failWithNoMotion(const RunRequest& request, const std::string& ini, const RunResult& result,
                                   const std::vector<std::string>& idle) {
  std::string logs;
  for (const auto& log : request.logs) logs += (logs.empty() ? "" : ", ") + log;
  throw base::Error(result.code == base::ExitCode::ok ? base::ExitCode::nothing_to_map : result.code,
                    logs + ": nothing to map: it does not tell how the sensors moved: there is nothing in it for " +
                        base::option_text::format(idle) + " of " + ini +
                        "; nothing was written. omnimapper-graphslam --check names the INIs that fit this log.\n" +
                        "What was read:\n" + result.source.text());
}

// The trajectory is written all the same: in the map's frame only by what [session] start says.
[[noreturn]] void failWithNoPlace(const RunRequest& request, const RunResult& result) {
  throw base::Error(result.code == base::ExitCode::ok ? base::ExitCode::not_located : result.code,
                    request.localize_map +
                        ": the log was located nowhere in the map: is it of another place? If not, " +
                        "say [session] start = anywhere, which seeks the whole map, or where it begins. Why: the " +
                        "refused closures in " + request.output_folder + "/report.html");
}

RunResult resultOf(const View& view) {
  RunResult result;
  result.key_frames = view.map.key_frames.size();
  result.factors = view.graph.factors().size();
  result.landmarks = countLandmarks(view);
  for (const auto& decision : view.decisions) {
    if (decision.kind != "loop closure") continue;
    ++(decision.accepted ? result.closures : result.refused_closures);
  }
  result.sessions = view.map.sessions;
  result.fixes = view.fixes.size();
  for (const auto& fix : view.fixes) result.located += fix.located();
  const auto figures = map::sessionFigures(view.map);
  if (!figures.empty() && figures.back().number == result.sessions.back().number) {
    result.new_key_frames = figures.back().key_frames;
    result.way = figures.back().way;
    result.log_seconds = figures.back().seconds;
  }
  return result;
}

// The most first; empty without landmarks.
std::string landmarkLine(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> rows(counts.begin(), counts.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [label, count] : rows) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + label;
  return text.empty() ? "" : "landmarks         " + text + "\n";
}

}  // namespace

const FixedSections& fixedSections() {
  static const FixedSections sections{
      {"mapper", EngineOptions::table().specs()},         {"perception", PerceptionOptions::table().specs()},
      {"session", SessionOptions::table().specs()},       {"trigger", TriggerOptions::table().specs()},
      {"solver", SolverOptions::table().specs()},         {"hypotheses", HypothesisOptions::table().specs()},
      {"source", source::SourceOptions::table().specs()}, {"<name of a sensor>", SensorPoseOptions::table().specs()}};
  return sections;
}

RunResult runMapping(const RunRequest& request, const base::Config& config, base::Progress& progress,
                     const std::function<bool()>& stop) {
  const StopWatch watch;
  checkRequest(request);
  const auto settings = EngineSettings::read(config);
  const auto& options = settings.engine;
  const auto perception = config.section("perception").read<PerceptionOptions>();
  const auto session = config.section("session").read<SessionOptions>();
  const auto source_options = config.section("source").read<source::SourceOptions>();
  loadPluginLibraries(config);
  SensorPoses sensor_poses(options.sensors, config);
  auto outputs = options.output_plugins;
  outputs.insert(outputs.end(), request.more_outputs.begin(), request.more_outputs.end());

  PluginContext context;
  context.motion = options.motion;
  context.map_is_held = !request.localize_map.empty();
  context.output_folder = request.output_folder;
  context.title = titleOf(request.logs);
  context.config_text = config.text();
  auto plugins =
      makePlugins({options.pose_plugins, perception.extractors, options.measurement_plugins, outputs}, config, context);
  config.refuseUnreadSections();
  std::set<std::string> measuring(options.measurement_plugins.begin(), options.measurement_plugins.end());
  std::vector<std::pair<std::string, const PosePlugin*>> sources;
  for (const auto& [section, plugin] : plugins.pose) {
    sources.emplace_back(section, plugin.get());
    if (!plugin->isFallback()) measuring.insert(section);
  }
  std::vector<std::pair<std::string, const perception::Extractor*>> extractors;
  for (const auto& [section, plugin] : plugins.extractors) extractors.emplace_back(section, plugin.get());
  Engine engine(settings, context.title, std::move(sensor_poses), std::move(plugins), request.threads);
  engine.setStop(stop);
  if (const auto off = config.switchedOffPlugins(); !off.empty()) {
    engine.warn(config.file() + ": no list of [mapper] or [perception] names the plugins " +
                base::option_text::format(off) + ": they are switched off");
  }
  loadMapInto(request, session, config.file(), options.motion, engine);
  source::ReadAhead log(source::openRawlogs(request.logs, source_options, stop), stop);
  const base::InputsKept kept(request.logs);
  base::makeWritableFolder(request.output_folder);
  bool stopped = false;
  const auto failure = tried(engine, [&] { stopped = feed(log, engine, request.speed, progress, stop); });
  const auto failure_at_end = tried(engine, [&] { engine.finish(); });

  const auto report = log.report();
  warnOfLog(report, stopped, engine);
  const auto unknown_labels = unknownLabels(config, labelledSections(options, perception), report, engine.view().map);
  for (const auto& sentence : unknown_labels) engine.warn(sentence);
  const auto warn = [&](const auto& all) {
    for (const auto& [section, plugin] : all) {
      for (const auto& sentence : plugin->warnings()) engine.warn("[" + section + "] " + sentence);
    }
  };
  warn(sources);
  warn(extractors);
  warnOfNothingMeasured(measuring, engine);
  auto result = resultOf(engine.view());
  warnOfCounts(engine.view().counts, result.new_key_frames, engine);
  warnOfSession(result.sessions.back(), engine);
  const bool is_lost = context.map_is_held && result.located == 0;
  if (context.map_is_held) warnOfFixes(result, engine);
  result.verdict = engine.view().verdict;
  const bool is_suspicious = result.verdict.answer == Verdict::Answer::suspicious;
  if (is_suspicious) engine.warn(sentenceOf(result.verdict) + " Look at map.png and report.html before you use it");
  result.warnings = engine.view().warnings;
  result.source = report;
  result.code = stopped ? base::ExitCode::interrupted : report.exitCode();
  if (result.code == base::ExitCode::ok) result.code = engine.extractionErrors().code();
  if (result.code == base::ExitCode::ok && request.strict && is_suspicious)
    result.code = base::ExitCode::suspicious_map;
  // A map that is continued is there already: better that one than one broken off.
  const bool keep_old = result.new_key_frames == 0 || !request.continue_map.empty();
  if (keep_old && failure) std::rethrow_exception(failure);
  if (keep_old && failure_at_end) std::rethrow_exception(failure_at_end);
  if (result.new_key_frames == 0) failWithNothingToMap(request, config.file(), result, unknown_labels);
  if (const auto idle = engine.idleSources(); !idle.empty() && !context.map_is_held && result.new_key_frames > 1)
    failWithNoMotion(request, config.file(), result, idle);
  progress.report(1.0, "writing the outputs");
  engine.writeOutputs();
  if (failure) std::rethrow_exception(failure);
  if (failure_at_end) std::rethrow_exception(failure_at_end);
  if (is_lost) failWithNoPlace(request, result);
  result.wall_seconds = watch.seconds();
  return result;
}

std::string toText(const RunResult& result, const std::string& output_folder) {
  std::string sessions;
  if (result.fixes > 0) {
    char located[128];
    std::snprintf(located, sizeof located, "located           %.1f %% of %zu key frames\n",
                  100.0 * static_cast<double>(result.located) / static_cast<double>(result.fixes), result.fixes);
    sessions = located;
  } else if (result.sessions.size() > 1) {
    const auto& session = result.sessions.back();
    sessions = "sessions          " + std::to_string(result.sessions.size()) + ", of " +
               std::to_string(result.new_key_frames) + " key frames the new one; " + joinedText(session) + "\n";
  }
  char text[512];
  std::snprintf(text, sizeof text,
                "key frames        %zu\n"
                "factors           %zu\n"
                "loop closures     %zu accepted, %zu refused (reasons: report.html)\n"
                "way               %.1f m in %.1f s\n"
                "wall time         %.2f s (%.0f times the log's own pace)\n",
                result.key_frames, result.factors, result.closures, result.refused_closures, result.way,
                result.log_seconds, result.wall_seconds,
                result.wall_seconds > 0 ? result.log_seconds / result.wall_seconds : 0.0);
  const std::string verdict =
      result.verdict.evidence.empty() ? "" : "verdict           " + sentenceOf(result.verdict) + "\n";
  return sessions + text + landmarkLine(result.landmarks) + verdict + "outputs           " + output_folder + "\n";
}

}  // namespace omnimapper::mapper
