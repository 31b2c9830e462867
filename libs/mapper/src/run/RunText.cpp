#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/derived/SessionAlignment.h>
#include <omnimapper/map/SessionMetrics.h>
#include <omnimapper/mapper/MappingRun.h>

#include <algorithm>
#include <cstdio>

namespace omnimapper::mapper {

namespace {

// Counts of landmarks, the largest first; empty without landmarks.
std::string landmarkLine(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> rows(counts.begin(), counts.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [label, count] : rows) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + label;
  return text.empty() ? "" : "landmarks         " + text + "\n";
}

// The files in the output folder that are not outputs; empty without any.
std::string foreignLine(const std::vector<std::string>& files) {
  constexpr std::size_t kMost = 4;
  if (files.empty()) return "";
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, files.size()); ++i) names += (i > 0 ? ", " : "") + files[i];
  if (files.size() > kMost) names += " and " + std::to_string(files.size() - kMost) + " more";
  const bool was_renamed =
      std::any_of(files.begin(), files.end(), [](const auto& name) { return name.find('~') != std::string::npos; });
  return "other files       " + names + " (not written by a run; kept" +
         (was_renamed ? "; NAME~ was NAME before" : "") + ")\n";
}

// Lines of a live run: its sensors, the counts of their observations, and the recording.
std::string liveLines(const LiveMetrics& live) {
  std::string sensors;
  for (const auto& sensor : live.sensors) {
    sensors += (sensors.empty() ? "" : ", ") + sensor.name + " " + std::to_string(sensor.observations);
    if (sensor.reopened > 0) sensors += " (came back " + base::counted(sensor.reopened, "time") + ")";
  }
  constexpr double kMegabyte = 1e6;
  const double megabytes = static_cast<double>(live.recorded_bytes) / kMegabyte;
  char text[512];
  std::snprintf(text, sizeof text,
                "observations      %llu arrived: %llu mapped, %llu dropped for newer frames, %llu lost because the "
                "disk was too slow, %llu unusable\nlatency           %.2f s from stamp to map, 99 %% below %.2f s\n",
                static_cast<unsigned long long>(live.arrived), static_cast<unsigned long long>(live.given),
                static_cast<unsigned long long>(live.dropped), static_cast<unsigned long long>(live.not_kept),
                static_cast<unsigned long long>(live.unusable), live.latency_median, live.latency_99);
  std::string lines = "sensors           " + sensors + "\n" + text;
  if (live.recording.empty()) return lines;
  std::snprintf(text, sizeof text, "recording         %.1f MB, on the disk %.1f MB, written at up to %.0f MB/s: %s\n",
                megabytes, static_cast<double>(live.bytes_on_disk) / kMegabyte,
                live.recorder_seconds > 0 ? megabytes / live.recorder_seconds : 0.0, live.recording.front().c_str());
  return lines + text;
}

// Empty if a robot was located by landmarks alone, without closures.
std::string closureLine(const RunResult& result, const std::string& scope) {
  if (result.localized > 0 && result.closures + result.refused_closures == 0 && !result.landmarks.empty()) return "";
  const std::string head = result.localized > 0 ? "matches with map  " : "loop closures     ";
  return head + std::to_string(result.closures) + " accepted, " + std::to_string(result.refused_closures) + " refused" +
         scope + " (reasons: report.html)\n";
}

}  // namespace

std::string toText(const RunResult& result) {
  std::string sessions;
  if (result.localized > 0) {
    char located[128];
    std::snprintf(located, sizeof located, "located           %.1f %% of %zu key frames\n",
                  100.0 * static_cast<double>(result.located) / static_cast<double>(result.localized),
                  result.localized);
    sessions = located;
  } else if (result.sessions.size() > 1) {
    const auto& session = result.sessions.back();
    sessions = "sessions          " + std::to_string(result.sessions.size()) + ", the new one with " +
               base::counted(result.new_key_frames, "key frame") + "; " + derived::alignedText(session) + "\n";
  }
  const std::size_t of_map = result.localized > 0 ? result.key_frames - result.new_key_frames : 0;
  const std::string held = of_map > 0 ? " (and " + std::to_string(of_map) + " of the map, which is not changed)" : "";
  // In a run that localizes, the factors of a key frame are removed when it leaves the window: their number would mean
  // nothing.
  const std::string factors = result.localized > 0 ? "" : "factors           " + std::to_string(result.factors) + "\n";
  const char* scope = result.localized == 0 && result.sessions.size() > 1 ? " in the new session" : "";
  std::string pace = derived::paceText(result.log_seconds, result.mapping_seconds);
  if (!pace.empty()) pace = ", " + pace + " times the log's own pace";
  char text[512];
  std::snprintf(text, sizeof text,
                "key frames        %zu%s\n"
                "%s"
                "%s"
                "travelled         %.1f m in %.1f s%s\n"
                "mapped in         %.2f s%s; %.2f s with the outputs\n",
                result.key_frames - of_map, held.c_str(), factors.c_str(), closureLine(result, scope).c_str(),
                result.travel, result.log_seconds, scope, result.mapping_seconds, pace.c_str(), result.wall_seconds);
  const std::string verdict =
      result.verdict.evidence.empty() ? "" : "verdict           " + sentenceOf(result.verdict) + "\n";
  const std::string level = result.level ? "level             " + sentenceOf(*result.level) + "\n" : "";
  return sessions + text + (result.live ? liveLines(*result.live) : "") + landmarkLine(result.landmarks) + level +
         verdict + "outputs           " + result.output_folder +
         (result.took_place ? " (replaced those of an earlier run)" : "") + "\n" + foreignLine(result.foreign_files);
}

}  // namespace omnimapper::mapper
