#include "run/RunWarnings.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/mapper/SessionAlignment.h>

#include "run/SourceWarnings.h"

namespace omnimapper::mapper {

namespace {

// A map without a single measurement is what the fallbacks say, and nobody should take it for more.
bool isMeasured(const View& view, const std::set<std::string>& measuring) {
  const auto session = view.map.sessions.back().number;
  for (const auto& [id, record] : view.graph.factors()) {
    if (id.session == session && measuring.count(record.tags.owner) > 0) return true;
  }
  return false;
}

// A wrong start may look right where rooms are alike.
void warnOfRefusedTies(const map::Session& session, bool stopped, Engine& engine) {
  const TestedTies ties = testedTies(engine.view().graph, session.number);
  if (!ties.areMostlyRefused()) return;
  engine.warn(joinedText(session) + ", but " + std::to_string(ties.refused) + " of the " +
              std::to_string(ties.refused + ties.accepted) + " measurements that tie it to the map " +
              (stopped ? "do not fit, or might have been borne out had the run not been interrupted"
                       : "do not fit: it may lie in a wrong place that looks alike, or the map is bent there. See "
                         "map.png; against a wrong place another [session] start helps (origin, pose, anywhere)"));
}

}  // namespace

void warnOfLog(const source::SourceReport& report, bool stopped, Engine& engine) {
  engine.setLeftOut(report.unusableCount());
  for (const auto& warning : warningsOf(report)) engine.warn(warning);
  if (stopped) engine.warn("interrupted: this is the map of what was read until then");
}

void warnOfCounts(const RunCounts& counts, std::size_t key_frames, Engine& engine) {
  const auto warn = [&](std::size_t count, const std::string& what) {
    if (count > 0) engine.warn(base::counted(count, "observation") + " " + what);
  };
  warn(counts.no_stamp, "without a stamp: left out");
  warn(counts.repeated_stamp,
       "with the stamp of the one before: left out; is a log given twice, or do two overlap? If the stamps stand "
       "still, [source] step_s stamps the log anew");
  warn(counts.too_late, "later than [mapper] horizon_s: left out");
  warn(counts.hurried,
       "worked on before [mapper] window_s was over, for more than queue_limit waited: do the stamps stand still?");
  warn(counts.unusable, "of odometry or poses, backwards in time or leaping: left out");
  warn(counts.unconnected,
       "without a pose: left out, for no pose plugin tells the motion; add a NoMotionPlugin to pose_plugins");
  if (key_frames == 1)
    engine.warn(
        "the map has one key frame: did robot or camera move, and does the log hold what tells how (odometry, scans, "
        "or images that overlap)?");
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
    engine.warn("[" + section + "] had nothing to work on: no observation of its kind came to a key frame. " +
                (missing.empty()
                     ? "Is it in the log (omnimapper-graphslam --check LOG), are labels and extractors right?"
                     : "There may be a remedy: " + missing));
  }
  if (view.map_is_held || view.map.key_frames.size() < 3 || isMeasured(view, measuring)) return;
  engine.warn(
      "nothing was measured: no plugin but the fallbacks made anything of any observation, the map is what " +
      std::string(
          "they say. Are the sensors blind? omnimapper-graphslam --check LOG (or --check --live) shows what they see"));
}

// What an earlier run said of its session is still so.
void warnOfEarlierSessions(const std::vector<map::Session>& sessions, Engine& engine) {
  for (std::size_t i = 0; i + 1 < sessions.size(); ++i) {
    if (!sessions[i].joined)
      engine.warn(joinedText(sessions[i]) +
                  " to the map, and still is not: it lies where its start says, which may be wrong");
  }
}

void warnOfSession(const map::Session& session, bool stopped, Engine& engine) {
  if (session.joined) return warnOfRefusedTies(session, stopped, engine);
  if (engine.view().map_is_held) return;
  engine.warn(
      joinedText(session) + " to the map: it lies where [session] start or a single " +
      "relocalisation says, which may be wrong; see the refused closures and relocalisations in the report. Is it of " +
      "another place? If not, drive on where the map was made, or give a better start (origin, pose, or anywhere)");
}

void warnOfLocalization(const RunResult& result, Engine& engine) {
  const std::string of_all = std::to_string(result.located) + " of " + std::to_string(result.localized) + " key frames";
  if (result.located == 0) {
    engine.warn("the log was located nowhere in the map: its trajectory lies where [session] start says");
  } else if (2 * result.located < result.localized) {
    engine.warn("only " + of_all + " were located: was much of the way outside the map, or is [session] start wrong? " +
                "start = anywhere searches the whole map");
  }
}

}  // namespace omnimapper::mapper
