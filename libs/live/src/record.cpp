#include <omnimapper/base/Numbers.h>
#include <omnimapper/live/record.h>

#include <chrono>
#include <cstdio>
#include <thread>

namespace omnimapper::live {

namespace {

constexpr double kMegabyte = 1e6;

std::string formatted(const char* format, double first, double second) {
  char text[160];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

}  // namespace

base::ExitCode Recorded::code() const {
  if (!failure.empty()) return base::ExitCode::disk_full;
  return counts.arrived == 0 ? base::ExitCode::nothing_to_map : base::ExitCode::ok;
}

Recorded record(const LiveOptions& options, const base::Config& config, const std::string& folder, double seconds,
                base::Progress& progress, const std::function<bool()>& stop) {
  using Clock = std::chrono::steady_clock;
  const auto sections = readSensors(options, config);  // an error here leaves no file
  LiveSource source(sections, options, std::make_unique<Recorder>(folder, nameByTime(), recorderOptions(options)));
  source.open(stop);
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  while (!stop() && source.recorder()->failure().empty() && (seconds == 0 || elapsed() < seconds)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    source.discardWaiting();
    for (const auto& sentence : source.takeNews()) progress.reportEvent(sentence);
    source.takeDropped();
    progress.reportState(source.sensorsText() +
                         formatted("; %.0f s, %.1f MB", elapsed(),
                                   static_cast<double>(source.recorder()->statistics().bytes_on_disk) / kMegabyte));
  }
  Recorded recorded;
  recorded.seconds = elapsed();
  recorded.sensors = source.sensors();
  source.close();
  const auto at_end = source.sensors();
  for (std::size_t i = 0; i < at_end.size(); ++i) {  // counts until the sensors were closed, with the state before that
    recorded.sensors[i].observations = at_end[i].observations;
    recorded.sensors[i].left_out = at_end[i].left_out;
  }
  recorded.counts = source.counts();
  recorded.statistics = source.recorder()->statistics();
  for (const auto& file : source.recorder()->files()) recorded.files.push_back(folder + "/" + file);
  recorded.failure = source.recorder()->failure();
  return recorded;
}

std::vector<std::string> troublesOf(const Recorded& recorded) {
  std::vector<std::string> all;
  for (const auto& sensor : recorded.sensors) {
    std::string trouble;
    if (sensor.observations == 0 && !sensor.sends_on_request) {
      trouble = "sent nothing that can be used";
    } else if (sensor.state != SensorMetrics::State::working) {
      trouble = "is " + toString(sensor.state);
    } else {
      continue;
    }
    if (sensor.left_out > 0)
      trouble += "; " + base::counted(sensor.left_out, "invalid message") + " " + base::wasOrWere(sensor.left_out) +
                 " discarded";
    if (!sensor.problem.empty()) trouble += "; " + sensor.problem;
    all.push_back("sensor [" + sensor.name + "] " + trouble);
  }
  return all;
}

std::string toText(const Recorded& recorded) {
  std::string text;
  for (const auto& sensor : recorded.sensors) {
    char line[192];
    std::snprintf(line, sizeof line, "%-17s %llu observations, %.1f Hz, %s\n", sensor.name.c_str(),
                  static_cast<unsigned long long>(sensor.observations),
                  recorded.seconds > 0 ? static_cast<double>(sensor.observations) / recorded.seconds : 0.0,
                  toString(sensor.state).c_str());
    text += line;
  }
  const auto& statistics = recorded.statistics;
  const auto megabytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / kMegabyte; };
  char line[256];
  std::snprintf(line, sizeof line,
                "recorded          %llu of %llu observations in %.1f s: %.1f MB, on the disk %.1f MB\n",
                static_cast<unsigned long long>(statistics.observations),
                static_cast<unsigned long long>(recorded.counts.arrived), recorded.seconds, megabytes(statistics.bytes),
                megabytes(statistics.bytes_on_disk));
  text += line;
  if (statistics.seconds > 0)
    text += formatted("write speed       %.0f MB/s (sensors sent %.1f MB/s)\n",
                      megabytes(statistics.bytes) / statistics.seconds,
                      recorded.seconds > 0 ? megabytes(statistics.bytes) / recorded.seconds : 0.0);
  for (const auto& file : recorded.files) text += "rawlog            " + file + "\n";
  return text;
}

}  // namespace omnimapper::live
