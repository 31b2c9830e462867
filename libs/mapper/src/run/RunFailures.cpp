#include "run/RunFailures.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/OptionTable.h>

namespace omnimapper::mapper {

// An empty map is not written, because it would replace a good one.
void failWithNothingToMap(const Feed& feed, const std::string& ini, const RunResult& result,
                          const std::vector<std::string>& unknown_labels, const std::string& missing_extractors) {
  std::string labels;
  for (const auto& sentence : unknown_labels) labels += sentence + "\n";
  const bool is_whole = result.code == base::ExitCode::ok || result.code == base::ExitCode::mostly_left_out;
  if (is_whole && result.source.sensors.empty() && result.source.unusable.empty()) {
    throw base::Error(base::ExitCode::nothing_to_map, feed.name() + ": nothing to map: no observation was received; " +
                                                          feed.whatStays() + ". " + feed.checkHint() + ".");
  }
  if (2 * result.source.zeroStamps() > result.source.observations()) {
    labels +=
        std::to_string(result.source.zeroStamps()) + " of " +
        base::counted(static_cast<std::size_t>(result.source.observations()), "observation") +
        " have no stamp and were left out; set [source] step_s to the period of the sensor that is read most often.\n";
  }
  const std::string how = result.code == base::ExitCode::interrupted ? "interrupted before the first" : "no";
  throw base::Error(
      is_whole ? base::ExitCode::nothing_to_map : result.code,
      feed.name() + ": nothing to map: " + how + " observation that a measurement plugin of " + ini + " wants" +
          (is_whole ? " (see its [source], [perception] extractors and [mapper] measurement_plugins)" : "") + "; " +
          feed.whatStays() + ". " + feed.checkHint() + ".\n" + missing_extractors + labels + "What was read:\n" +
          result.source.text());
}

// Without measured motion the map is refused: all key frames would get the same pose.
void failWithNoMotion(const Feed& feed, const std::string& ini, const RunResult& result,
                      const std::vector<std::string>& idle) {
  throw base::Error(
      result.code == base::ExitCode::ok ? base::ExitCode::nothing_to_map : result.code,
      feed.name() +
          ": nothing to map: the motion of the sensors cannot be determined, because there are no observations for " +
          base::option_text::format(idle) + " of " + ini + "; " + feed.whatStays() +
          ". omnimapper-graphslam --check names the INIs that fit this log.\n" + "What was read:\n" +
          result.source.text());
}

// Fails after the trajectory was written: its place in the map is only that of [session] start.
void failWithNoPlace(const RunRequest& request, const RunResult& result, SessionOptions::Start start) {
  const bool was_sought = start == SessionOptions::Start::anywhere;
  const bool was_compared = result.closures + result.refused_closures > 0;
  const std::string report = result.output_folder + "/report.html";
  if (result.code == base::ExitCode::interrupted)
    throw base::Error(result.code,
                      request.localize_map + ": the run was interrupted before the log was located in the map");
  const auto code = result.code == base::ExitCode::ok ? base::ExitCode::not_located : result.code;
  if (result.awaits_confirmation) {
    throw base::Error(code,
                      request.localize_map +
                          ": the log was located nowhere in the map: one place fits, but the log ends before a second "
                          "match confirms it; drive some metres further. The place is among the decisions in " +
                          report);
  }
  throw base::Error(
      code,
      request.localize_map +
          ": the log was located nowhere in the map: was it recorded in another place? If not, set " +
          (was_sought ? "" : "[session] start = anywhere, which searches the whole map, or ") +
          "another start (origin, pose). " +
          (was_compared
               ? "The refused closures with their reasons are in " + report
               : "No loop closure with the map was considered; what was tried is among the decisions in " + report +
                     ". To compare laser scans, use an INI with a LoopClosurePlugin; without scans the "
                     "map needs landmarks of the kinds that the INI measures"));
}

void failWithNoTie(const std::string& ini) {
  throw base::Error(base::ExitCode::command_line,
                    ini + ": it has no plugin that can tie a log to a map: --continue and --localize need one of " +
                        "[mapper] measurement_plugins, such as loop_closure for a laser, or landmarks");
}

}  // namespace omnimapper::mapper
