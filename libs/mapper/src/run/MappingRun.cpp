#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/derived/SessionAlignment.h>
#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/SensorSection.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/map/SessionMetrics.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/plugin/LandmarkShape.h>
#include <omnimapper/source/SourceOptions.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "Engine.h"
#include "run/Feed.h"
#include "run/MissingExtractors.h"
#include "run/PluginDifference.h"
#include "run/RunFailures.h"
#include "run/RunWarnings.h"
#include "run/SensorLabels.h"
#include "sessions/MapLoader.h"

namespace omnimapper::mapper {

namespace {

// Runs `work`. If it throws, the map of what came before it is kept; returns the exception.
std::exception_ptr tried(Engine& engine, const std::function<void()>& work) {
  try {
    work();
    return nullptr;
  } catch (const std::exception& error) {
    engine.warn(std::string("the run broke off: ") + error.what() + "; the map contains what was read before");
    return std::current_exception();
  }
}

// Sections whose keys `label` and `labels` name sensors.
std::vector<std::string> labelledSections(const EngineOptions& options, const PerceptionOptions& perception) {
  std::vector<std::string> sections = options.sensors;
  sections.emplace_back("calibration");
  for (const auto* names : {&options.pose_plugins, &perception.extractors, &options.measurement_plugins}) {
    sections.insert(sections.end(), names->begin(), names->end());
  }
  return sections;
}

RunResult resultOf(const View& view) {
  RunResult result;
  result.key_frames = view.map.key_frames.size();
  result.factors = view.graph.factors().size();
  result.landmarks = countLandmarks(view);
  const auto closures = countClosures(view.decisions);
  result.closures = closures.accepted;
  result.refused_closures = closures.refused;
  result.sessions = view.map.sessions;
  const auto* level = view.map.layers.find<map::Level>();
  if (!view.map_is_held && level) result.level = *level;
  result.live = view.live;
  result.localized = view.localization.size();
  for (const auto& estimate : view.localization) result.located += estimate.located();
  for (const auto& decision : view.decisions)
    result.awaits_confirmation |= decision.kind == kRelocalization && decision.accepted;
  const auto metrics = map::sessionMetrics(view.map);
  if (!metrics.empty() && metrics.back().number == result.sessions.back().number) {
    result.new_key_frames = metrics.back().key_frames;
    result.travel = metrics.back().travel;
    result.log_seconds = metrics.back().seconds;
  }
  return result;
}

constexpr char kInterrupted[] = "interrupted";  // folder for the outputs of an incomplete run

// One run of an INI over its logs: call open(), feed(), finish() and report() in this order.
class Run {
 public:
  Run(const RunRequest& request, const base::Config& config, base::Progress& progress,
      const std::function<bool()>& stop)
      : request_(request), config_(config), progress_(progress), stop_(stop) {}

  void open();
  void feed();
  void finish();
  RunResult report();

 private:
  void makeEngine();
  PluginDifference prepareChange(const base::Config& next);
  std::string applyChange(PluginDifference difference, const base::Config& next);
  void judgeInput();
  std::vector<std::string> warn(const RunResult& result);
  void publish(const std::vector<base::Error>& failures, RunResult& result);
  void refuseToReplaceRun() const;
  bool continuesItsFolder() const;
  void keepContinuedMap();
  std::vector<std::string> foreignFiles() const;
  void showToTheEnd(const RunResult& result);
  void complete(RunResult& result) const;
  std::string missingFor(const std::string& section) const;
  bool isSuspicious() const { return engine_->view().verdict.answer == Verdict::Answer::suspicious; }
  bool localizes() const { return !request_.localize_map.empty(); }

  StopWatch watch_;
  const RunRequest& request_;
  const base::Config& config_;
  base::Progress& progress_;
  const std::function<bool()>& stop_;
  EngineSettings settings_ = EngineSettings::read(config_);
  const PerceptionOptions perception_ = config_.section("perception").read<PerceptionOptions>();
  const std::unique_ptr<Feed> feed_ = makeFeed(request_, config_);

  PluginContext context_;
  std::optional<base::Config> changed_config_;  // the INI of the present plugins, if they were changed
  std::set<std::string> measuring_;             // sections of plugins that measure
  SensorSamples samples_;
  base::OutputFolder outputs_{request_.output_folder};  // before the engine, whose plugins write into it to their end
  std::optional<Engine> engine_;
  std::optional<base::InputsKept> kept_;
  bool stopped_ = false;
  std::exception_ptr failure_, failure_at_end_;  // thrown by feed(), and by finish()
};

// Opens and checks everything for which an INI, a map or a log can be refused.
void Run::open() {
  makeEngine();
  if (!feed_->endsWhenStopped()) engine_->setStop(stop_);
  if (const auto off = config_.switchedOffPlugins(); !off.empty()) {
    engine_->warn(config_.file() + ": no list of [mapper] or [perception] names the plugins " +
                  base::option_text::format(off) + ": they are switched off");
  }
  if (request_.continue_map.empty() && !localizes() && config_.has("session"))
    engine_->warn(config_.placeOf("session") +
                  ": [session] gives the start of a log in a map that it continues or is localized in; without "
                  "--continue or --localize it has no effect");
  if (settings_.engine.measurement_plugins.empty() && (localizes() || !request_.continue_map.empty())) {
    failWithNoTie(config_.file());
  }
  loadMapInto(request_, settings_, config_, *engine_);
  feed_->open(stop_);
  kept_.emplace(feed_->inputs());
  outputs_.open();
  refuseToReplaceRun();
  feed_->setPluginChanger({[this](const base::Config& next) { return prepareChange(next); },
                           [this](PluginDifference difference, const base::Config& next) {
                             return applyChange(std::move(difference), next);
                           }});
  feed_->begin(outputs_.folder(), stop_);
}

void Run::makeEngine() {
  const auto& options = settings_.engine;
  SensorPoses sensor_poses(options.sensors, config_);
  const auto outputs = outputSections(config_, request_.more_outputs);
  context_.motion = options.motion;
  context_.map_is_held = localizes();
  context_.output_folder = outputs_.staging();
  context_.title = feed_->title();
  context_.config_text = config_.text();
  context_.run_folder = outputs_.folder();
  context_.growing_folder = outputs_.growing();
  context_.say = [this](const std::string& sentence) { progress_.reportEvent(sentence); };
  auto plugins = makePlugins({options.pose_plugins, perception_.extractors, measurementSections(config_), outputs.made},
                             config_, context_);
  config_.refuseUnreadSections();
  measuring_.insert(options.measurement_plugins.begin(), options.measurement_plugins.end());
  for (const auto& [section, plugin] : plugins.pose)
    if (!plugin->isFallback()) measuring_.insert(section);
  engine_.emplace(settings_, context_.title, std::move(sensor_poses), std::move(plugins), request_.threads,
                  feed_->schedule());
  for (const auto& sentence : outputs.left_out) engine_->warn(sentence);
}

// Settings of other sections than those of plugins hold until the run ends.
PluginDifference Run::prepareChange(const base::Config& next) {
  std::vector<std::string> looked_at;
  for (const auto& [section, plugin] : engine_->plugins().output)
    if (plugin->isLookedAt()) looked_at.push_back(section);
  auto difference =
      differenceOf(changed_config_ ? *changed_config_ : config_, next, request_.more_outputs, context_, looked_at);
  next.refuseUnreadSections(config_);
  if (!difference.unused.empty())
    engine_->warn("a change of the INI during the run needs a new run to have an effect: " +
                  base::option_text::format(difference.unused));
  if (next.section("mapper").read<EngineOptions>().measurement_plugins.empty() &&
      (localizes() || !request_.continue_map.empty()))
    failWithNoTie(next.file());
  return difference;
}

std::string Run::applyChange(PluginDifference difference, const base::Config& next) {
  const std::string changed = "the plugins were changed: " + difference.sentence();
  const auto order = difference.change.order;
  const std::string problem = engine_->changePlugins(std::move(difference.change));
  if (!problem.empty()) {
    engine_->warn("the plugins stay as they were: " + problem);
    return "the plugins stay as they were: " + problem;
  }
  measuring_.insert(order.measurement.begin(), order.measurement.end());
  for (const auto& [section, plugin] : engine_->plugins().pose)
    if (!plugin->isFallback()) measuring_.insert(section);
  changed_config_ = next;
  context_.config_text = next.text();
  engine_->note(changed);
  return changed;
}

void Run::feed() {
  failure_ = tried(*engine_, [&] { stopped_ = feed_->feed(*engine_, samples_, progress_, stop_); });
}

// A map is not lost because its log cannot be judged.
void Run::judgeInput() {
  try {
    auto judgement = request_.watch->judgement();
    for (const auto& sentence : judgement.warnings) engine_->warn(sentence);
    engine_->setInputEvidence(std::move(judgement.evidence));
  } catch (const std::exception& error) {
    engine_->warn(std::string("the log was not checked: ") + error.what());
  }
}

void Run::finish() {
  if (request_.watch && !localizes() && !stopped_) judgeInput();
  failure_at_end_ = tried(*engine_, [&] { engine_->finish(); });
}

// Adds the warnings about the run. Returns a sentence for each label that the INI names and the log lacks.
std::vector<std::string> Run::warn(const RunResult& result) {
  const auto report = feed_->report();
  warnOfLog(report, stopped_, *engine_);
  auto unknown_labels =
      unknownLabels(config_, labelledSections(settings_.engine, perception_), report, engine_->view().map);
  for (const auto& sentence : unknown_labels) engine_->warn(sentence);
  const auto warn_of = [&](const auto& all) {
    for (const auto& [section, plugin] : all) {
      for (const auto& sentence : plugin->warnings()) engine_->warn("[" + section + "] " + sentence);
    }
  };
  warn_of(engine_->plugins().pose);
  warn_of(engine_->plugins().extractors);
  warn_of(engine_->plugins().measurement);
  warnOfNothingMeasured(
      measuring_, [this](const std::string& section) { return missingFor(section); }, *engine_);
  warnOfCounts(engine_->view().counts, result.new_key_frames, *engine_);
  warnOfEarlierSessions(result.sessions, *engine_);
  warnOfSession(result.sessions.back(), stopped_, *engine_);
  if (localizes()) warnOfLocalization(result, *engine_);
  if (isSuspicious())
    engine_->warn(sentenceOf(engine_->view().verdict) + " Look at map.png and report.html before you use it");
  return unknown_labels;
}

// What would give the plugin observations to work on; empty if nothing is known to help.
std::string Run::missingFor(const std::string& section) const {
  for (const auto& [name, plugin] : engine_->plugins().measurement) {
    if (name != section || plugin->worksOnLandmarks() || samples_.isFedBy(engine_->plugins().extractors, *plugin))
      continue;
    return samples_.extractorsFor(*plugin);
  }
  return "";
}

// Completes the result with what is only known after warn(), and with the exit code.
void Run::complete(RunResult& result) const {
  result.verdict = engine_->view().verdict;
  result.warnings = engine_->view().warnings;
  result.source = feed_->report();
  result.code = stopped_ ? base::ExitCode::interrupted : feed_->code();
  if (result.code == base::ExitCode::ok) result.code = engine_->extractionErrors().code();
  if (result.code == base::ExitCode::ok && isMostlyLeftOut(engine_->view().counts))
    result.code = base::ExitCode::mostly_left_out;
  if (result.code == base::ExitCode::ok && request_.strict && isSuspicious())
    result.code = base::ExitCode::suspicious_map;
}

// Replaces the outputs of an older run. The outputs of an incomplete run, and those that cannot be put in place, never
// replace a complete run: they go to a separate folder. Throws all errors of the outputs as one.
void Run::publish(const std::vector<base::Error>& failures, RunResult& result) {
  std::vector<base::Error> errors;
  for (const auto& error : failures) errors.emplace_back(error.code(), outputs_.asTheUserSees(error.what()));
  const bool held_run = outputs_.holdsRun();
  bool is_separate = held_run && (stopped_ || failure_ || failure_at_end_ || !errors.empty());
  if (!is_separate) {
    try {
      keepContinuedMap();
      outputs_.commit();
    } catch (const base::Error& error) {
      errors.push_back(error);
      is_separate = !outputs_.isCommitted();
    }
  }
  result.output_folder = outputs_.folder() + (is_separate ? std::string("/") + kInterrupted : "");
  try {
    is_separate ? outputs_.commitInto(kInterrupted) : outputs_.removeInner(kInterrupted);
  } catch (const base::Error& error) {
    is_separate ? errors.push_back(error) : result.warnings.push_back(error.what());
  }
  result.took_place = held_run && !is_separate;
  result.foreign_files = foreignFiles();
  const std::string older = is_separate ? outputs_.folder() +
                                              " is unchanged; the outputs of this run, which is incomplete, are in " +
                                              result.output_folder
                                        : "";
  if (!errors.empty()) {
    std::string sentences;
    for (const auto& error : errors) sentences += error.what() + std::string("\n");
    throw base::Error(errors.front().code(), sentences + older);
  }
  if (is_separate) result.warnings.push_back(older);
}

std::vector<std::string> Run::foreignFiles() const {
  auto files = outputs_.foreignFiles();
  for (const auto& own : feed_->files()) files.erase(std::remove(files.begin(), files.end(), own), files.end());
  return files;
}

void Run::refuseToReplaceRun() const {
  const auto& folder = outputs_.folder();
  const bool holds_checkpoint = std::filesystem::exists(folder + "/" + kCheckpoint);
  if ((!outputs_.holdsRun() && !holds_checkpoint) || continuesItsFolder()) return;
  const std::string why = feed_->keepsRunIn(folder);
  if (why.empty()) return;
  throw base::Error(base::ExitCode::unwritable_output,
                    folder + ": holds the map of an earlier run, and " + why +
                        "; give another folder (-o), or continue that map (--continue " + folder + ")");
}

// Whether the continued map lies in the output folder.
bool Run::continuesItsFolder() const {
  if (request_.continue_map.empty()) return false;
  std::error_code none;
  const std::filesystem::path map = request_.continue_map;
  const auto folder = std::filesystem::is_directory(map, none) ? map : map.parent_path();
  return std::filesystem::equivalent(folder, outputs_.folder(), none);
}

// Keeps a continued map in its folder even if this INI does not write it.
void Run::keepContinuedMap() {
  if (continuesItsFolder()) outputs_.keep("map.omnimap");
}

// Waits until the window is closed or the user stops the run.
void Run::showToTheEnd(const RunResult& result) {
  if (!engine_->isLookedAt() || stop_()) return;
  const bool is_broken = failure_ || failure_at_end_ || (localizes() && result.located == 0);
  if (request_.before_window_closes && !is_broken) request_.before_window_closes(result);
  while (engine_->isLookedAt() && !stop_()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

// Writes the outputs. Throws if nothing is worth writing, and at the end rethrows the exception that broke the run off.
RunResult Run::report() {
  auto outcome = resultOf(engine_->view());
  const auto unknown_labels = warn(outcome);
  complete(outcome);
  // A continued map already exists, and is better than one of a run that broke off.
  const bool keep_old = outcome.new_key_frames == 0 || !request_.continue_map.empty();
  if (keep_old && failure_) std::rethrow_exception(failure_);
  if (keep_old && failure_at_end_) std::rethrow_exception(failure_at_end_);
  if (outcome.new_key_frames == 0) {
    std::string missing;
    for (const auto& [section, plugin] : engine_->plugins().measurement) {
      if (const auto sentence = missingFor(section); !sentence.empty())
        missing += "[" + section + "]: " + sentence + ".\n";
    }
    failWithNothingToMap(*feed_, config_.file(), outcome, unknown_labels, missing);
  }
  if (const auto idle = engine_->idleSources(); !idle.empty() && !localizes() && outcome.new_key_frames > 1)
    failWithNoMotion(*feed_, config_.file(), outcome, idle);
  outcome.mapping_seconds = watch_.seconds();
  engine_->setMappingSeconds(outcome.mapping_seconds);
  progress_.report(1.0, "writing the outputs");
  publish(engine_->writeOutputs(), outcome);
  feed_->published(outcome.output_folder);
  for (const auto& [section, plugin] : engine_->plugins().output) plugin->published(outcome.output_folder);
  // While a page shows what the run made instead of a map in the folder, other programs leave the folder alone.
  if (!std::filesystem::exists(outputs_.growing())) outputs_.release();
  outcome.wall_seconds = watch_.seconds();
  showToTheEnd(outcome);
  if (failure_) std::rethrow_exception(failure_);
  if (failure_at_end_) std::rethrow_exception(failure_at_end_);
  if (localizes() && outcome.located == 0) failWithNoPlace(request_, outcome, settings_.session.start);
  return outcome;
}

}  // namespace

const FixedSections& fixedSections() {
  static const FixedSections sections{{"mapper", EngineOptions::table().specs()},
                                      {"perception", PerceptionOptions::table().specs()},
                                      {"session", SessionOptions::table().specs()},
                                      {"trigger", TriggerOptions::table().specs()},
                                      {"solver", SolverOptions::table().specs()},
                                      {"hypotheses", HypothesisOptions::table().specs()},
                                      {"source", source::SourceOptions::table().specs()},
                                      {"live", live::LiveOptions::table().specs()},
                                      {"NAME OF A LIVE SENSOR", live::SensorOptions::table().specs()},
                                      {"NAME OF A SENSOR", SensorPoseOptions::table().specs()},
                                      {"calibration", camera::CameraCalibrationOptions::table().specs()}};
  return sections;
}

RunResult runMapping(const RunRequest& request, const base::Config& config, base::Progress& progress,
                     const std::function<bool()>& stop) {
  checkRequest(request);
  loadPluginLibraries(config);
  Run run(request, config, progress, stop);
  run.open();
  run.feed();
  run.finish();
  return run.report();
}

}  // namespace omnimapper::mapper
