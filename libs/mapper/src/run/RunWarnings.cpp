#include "run/RunWarnings.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/SessionAlignment.h>

#include "run/SourceWarnings.h"

namespace omnimapper::mapper {

namespace {

// Whether any plugin that measures made a factor in this session. Otherwise the map only shows what the fallbacks
// assume.
bool isMeasured(const View& view, const std::set<std::string>& measuring) {
  const auto session = view.map.sessions.back().number;
  for (const auto& [id, record] : view.graph.factors()) {
    if (id.session == session && measuring.count(record.tags.owner) > 0) return true;
  }
  return false;
}

// Warns of a session that may be aligned to a wrong place, where rooms look alike.
void warnOfRefusedTies(const map::Session& session, bool stopped, Engine& engine) {
  const derived::TestedTies ties = derived::testedTies(engine.view().graph, session.number);
  if (!ties.areMostlyRefused()) return;
  engine.warn(
      derived::alignedText(session) + ", but " + std::to_string(ties.refused) + " of the " +
      std::to_string(ties.refused + ties.accepted) + " measurements that tie it to the map " +
      (stopped ? "do not fit, or were not confirmed before the run was interrupted"
               : "do not fit: it may be aligned to a wrong place that looks similar, or the map is distorted there. "
                 "See map.png; if the place is wrong, set another [session] start (origin, pose, anywhere)"));
}

}  // namespace

void warnOfLog(const source::SourceReport& report, bool stopped, Engine& engine) {
  engine.setLeftOut(report.unusableCount());
  for (const auto& warning : warningsOf(report)) engine.warn(warning);
  if (stopped) engine.warn("interrupted: the map contains what was read until then");
}

void warnOfCounts(const RunCounts& counts, std::size_t key_frames, Engine& engine) {
  const auto warn = [&](std::size_t count, const std::string& what) {
    if (count > 0) engine.warn(base::counted(count, "observation") + " " + what);
  };
  warn(counts.no_stamp, "without a stamp: left out");
  warn(counts.repeated_stamp,
       "with the stamp of the one before: left out; is a log given twice, or do two overlap? If the stamps do not "
       "advance, [source] step_s assigns new ones");
  warn(counts.too_late, "later than [mapper] horizon_s: left out");
  warn(counts.hurried,
       "processed before [mapper] window_s was over, because more than queue_limit stamps were waiting: do the stamps "
       "not advance?");
  warn(counts.unusable, "of odometry or poses left out, because they go back in time or jump");
  warn(counts.unconnected,
       "without a pose: left out, because no pose plugin has the motion; add a NoMotionPlugin to pose_plugins");
  if (key_frames == 1)
    engine.warn(
        "the map has one key frame: did the robot or camera move, and does the log contain data to estimate its motion "
        "(odometry, scans, or overlapping images)?");
}

bool isMostlyLeftOut(const RunCounts& counts) {
  return 2 * (counts.no_stamp + counts.repeated_stamp + counts.too_late + counts.unusable + counts.unconnected) >
         counts.observations;
}

void warnOfNothingMeasured(const std::set<std::string>& measuring,
                           const std::function<std::string(const std::string&)>& missing_for, Engine& engine) {
  const View view = engine.view();
  for (const auto& section : engine.idlePlugins()) {
    const std::string missing = missing_for(section);
    engine.warn(
        "[" + section + "] had nothing to work on: no key frame has an observation of its kind. " +
        (missing.empty()
             ? "Does the log contain one (omnimapper-graphslam --check LOG), and are labels and extractors right?"
             : "There may be a remedy: " + missing));
  }
  if (view.map_is_held || view.map.key_frames.size() < 3 || isMeasured(view, measuring)) return;
  engine.warn(
      "nothing was measured: no plugin except the fallbacks used any observation, so the map shows only what " +
      std::string(
          "they assume. Do the sensors see anything? omnimapper-graphslam --check LOG (or --check --live) shows it"));
}

// The session is still unaligned, as an earlier run warned already.
void warnOfEarlierSessions(const std::vector<map::Session>& sessions, Engine& engine) {
  for (std::size_t i = 0; i + 1 < sessions.size(); ++i) {
    if (!sessions[i].aligned)
      engine.warn(derived::alignedText(sessions[i]) +
                  " with the map: it lies at its assumed start, which may be wrong");
  }
}

void warnOfSession(const map::Session& session, bool stopped, Engine& engine) {
  if (session.aligned) return warnOfRefusedTies(session, stopped, engine);
  if (engine.view().map_is_held) return;
  engine.warn(
      derived::alignedText(session) +
      " with the map: it lies where [session] start or a single relocalization places it, which may be wrong; see the "
      "refused closures and relocalizations in the report. Was "
      "it recorded in another place? If not, drive on where the map was made, or give a better start (origin, pose, or "
      "anywhere)");
}

void warnOfLocalization(const RunResult& result, Engine& engine) {
  const std::string of_all = std::to_string(result.located) + " of " + std::to_string(result.localized) + " key frames";
  if (result.located == 0) {
    engine.warn("the log was located nowhere in the map: its trajectory lies at the assumed [session] start");
  } else if (2 * result.located < result.localized) {
    engine.warn("only " + of_all +
                " were located: was much of the drive outside the map, or is [session] start wrong? " +
                "start = anywhere searches the whole map");
  }
}

}  // namespace omnimapper::mapper
