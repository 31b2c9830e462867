// How the cost of a map grows with the length of the log: one log is driven forward, backward, forward, ... for several
// passes, with shifted stamps and continuous odometry, and mapped with one INI. Prints a Markdown table and writes a
// CSV.
//
// Example: bench-there_and_back -i ini/laser2d.ini -r aces.rawlog -o out/length
#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using namespace omnimapper;
using Observation = mrpt::obs::CObservation::Ptr;

std::vector<Observation> read(const std::string& path) {
  const auto log = source::openLogs({path}, {});
  std::vector<Observation> all;
  while (auto observation = log->next()) {
    if (base::isValid(observation->timestamp)) all.push_back(observation);
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return all;
}

// Pass k runs through the log forward if k is even, else backward, so that the last observations of a pass are the
// first of the next one. The robot rests for a second between two passes.
void write(const std::vector<Observation>& log, int passes, const std::string& path) {
  const base::Stamp begin = log.front()->timestamp, end = log.back()->timestamp;
  const base::Duration pass = end - begin + base::durationFromSeconds(1);
  source::writeRawlog(path, [&](source::RawlogWriter& writer) {
    for (int k = 0; k < passes; ++k) {
      for (std::size_t i = 0; i < log.size(); ++i) {
        const auto& original = *log[k % 2 == 0 ? i : log.size() - 1 - i];
        const auto copy = std::dynamic_pointer_cast<mrpt::obs::CObservation>(original.duplicateGetSmartPtr());
        const base::Duration into = k % 2 == 0 ? original.timestamp - begin : end - original.timestamp;
        copy->timestamp = begin + k * pass + into;
        writer.add(*copy);
      }
    }
  });
}

struct Row {
  int passes;
  std::size_t key_frames, closures;
  double wall, solve, early, late;  // [s] [s] [ms] [ms]
};

Row row(int passes, const mapper::RunResult& result, const nlohmann::json& summary) {
  const auto& tenths = summary.at("cost_per_key_frame");
  const auto cost = [](const nlohmann::json& tenth) {
    return tenth.at("plugins_ms").get<double>() + tenth.at("solve_ms").get<double>() +
           tenth.at("engine_ms").get<double>();
  };
  double solve = 0;
  for (const auto& record : summary.at("solves")) solve += record.at("seconds").get<double>();
  return {passes, result.key_frames,    result.closures,    result.wall_seconds,
          solve,  cost(tenths.front()), cost(tenths.back())};
}

}  // namespace

int main(int argc, char** argv) {
  std::string ini, log, out;
  std::vector<int> passes{1, 2, 4, 8};
  int threads = 1;
  std::vector<std::string> settings;
  CLI::App app("Maps a log driven forward, backward, forward, ... and reports how the cost grows with its length.");
  app.add_option("-i,--ini", ini)->required();
  app.add_option("-r,--rawlog", log)->required();
  app.add_option("-o,--output", out)->required();
  app.add_option("--passes", passes, "numbers of passes through the log");
  app.add_option("--threads", threads);
  app.add_option("--set", settings, "section.key=value");
  CLI11_PARSE(app, argc, argv);
  omnimapper::mapper::loadFeatures();
  std::filesystem::create_directories(out);
  const auto observations = read(log);
  std::ofstream csv(out + "/length.csv");
  csv << "passes,key_frames,closures,wall_s,solve_s,first_tenth_ms_per_key_frame,last_tenth_ms_per_key_frame\n";
  std::printf(
      "| passes | key frames | closures | wall [s] | in solves [s] | first tenth [ms per key frame] | last tenth |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const int count : passes) {
    const std::string name = out + "/" + std::to_string(count);
    write(observations, count, name + ".rawlog");
    auto config = base::Config::fromFile(ini);
    for (const auto& setting : settings) config.set(setting);
    mapper::RunRequest request;
    request.logs = {name + ".rawlog"};
    request.output_folder = name;
    request.threads = threads;
    base::Progress quiet;
    const auto result = mapper::runMapping(request, config, quiet, [] { return false; });
    const Row r = row(count, result, nlohmann::json::parse(std::ifstream(name + "/summary.json")));
    std::printf("| %d | %zu | %zu | %.2f | %.2f | %.2f | %.2f |\n", r.passes, r.key_frames, r.closures, r.wall, r.solve,
                r.early, r.late);
    std::fflush(stdout);
    csv << r.passes << "," << r.key_frames << "," << r.closures << "," << r.wall << "," << r.solve << "," << r.early
        << "," << r.late << "\n";
  }
}
