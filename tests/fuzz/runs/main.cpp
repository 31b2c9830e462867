// Runs the programs of the project on logs, maps, INIs and folders with errors that random bytes would rarely give:
// values, stamps, labels, order, numbers under valid checksums. complaint() lists what a run must not do. Each run
// depends only on its number, so that it can be repeated.
//
// Example: fuzz-runs logs --count 5000 -o out/fuzz
#include <omnimapper/obs/registerClasses.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "FuzzedRuns.h"

namespace {

using namespace omnimapper;
namespace fs = std::filesystem;

struct Arguments {
  std::string wrong, output, programs;
  std::uint64_t first = 1, count = 100;
  double seconds = 0;
  fuzz::Bounds bounds;
};

// How the runs of one scene ended.
struct Statistics {
  std::size_t runs = 0, complaints = 0;
  double most_seconds = 0, most_mib = 0;
  std::map<std::string, std::size_t> ends;  // number of runs by exit code or signal
};

void add(const testing::Ended& ended, Statistics& statistics) {
  ++statistics.runs;
  ++statistics.ends[ended.signal != 0 ? "signal " + std::to_string(ended.signal) : std::to_string(ended.code)];
  statistics.most_seconds = std::max(statistics.most_seconds, ended.own_seconds);
  statistics.most_mib = std::max(statistics.most_mib, ended.peak_mib);
}

void keep(const fs::path& kept, const fs::path& folder, const fuzz::FuzzedRun& fuzzed, const testing::Ended& ended,
          const std::string& why) {
  fs::remove_all(kept);
  fs::create_directories(kept.parent_path());
  fs::copy(folder, kept, fs::copy_options::recursive);
  std::ofstream out(kept / "trial.txt");
  out << why << "\n";
  for (const auto& word : fuzzed.command) out << word << " ";
  out << "\n" << toString(ended) << "\n";
}

void print(const std::map<std::string, Statistics>& by_scene) {
  std::printf(
      "| scene | runs | complaints | longest [s] | most memory [MiB] | exit codes (times) "
      "|\n|---|---|---|---|---|---|\n");
  Statistics all;
  for (const auto& [name, statistics] : by_scene) {
    std::string ends;
    for (const auto& [end, times] : statistics.ends)
      ends += (ends.empty() ? "" : ", ") + end + " (" + std::to_string(times) + ")";
    std::printf("| %s | %zu | %zu | %.1f | %.0f | %s |\n", name.c_str(), statistics.runs, statistics.complaints,
                statistics.most_seconds, statistics.most_mib, ends.c_str());
    all.runs += statistics.runs;
    all.complaints += statistics.complaints;
    all.most_seconds = std::max(all.most_seconds, statistics.most_seconds);
    all.most_mib = std::max(all.most_mib, statistics.most_mib);
  }
  std::printf("| all | %zu | %zu | %.1f | %.0f | |\n", all.runs, all.complaints, all.most_seconds, all.most_mib);
}

int run(const Arguments& arguments) {
  const auto kind = std::find(fuzz::kNamesOfWrong.begin(), fuzz::kNamesOfWrong.end(), arguments.wrong);
  const auto wrong = static_cast<fuzz::Wrong>(kind - fuzz::kNamesOfWrong.begin());
  const std::string shared = arguments.output + "/shared", folder = arguments.output + "/trial";
  fs::remove_all(shared);
  fs::create_directories(shared);
  const fuzz::FuzzedRuns runs(wrong, fs::absolute(arguments.programs), fs::absolute(shared));
  const auto start = std::chrono::steady_clock::now();
  const auto isOver = [&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return arguments.seconds > 0 && passed.count() > arguments.seconds;
  };
  std::map<std::string, Statistics> by_scene;
  std::size_t complaints = 0;
  for (std::uint64_t i = 0; i < arguments.count && !isOver(); ++i) {
    const std::uint64_t number = arguments.first + i;
    const auto fuzzed = runs.make(number, fs::absolute(folder));
    const auto ended = testing::runProgram(fuzzed.command, {arguments.bounds.seconds + 1});
    auto& statistics = by_scene[fuzzed.name];
    add(ended, statistics);
    const auto why = fuzz::complaint(ended, arguments.bounds);
    if (!why) continue;
    ++statistics.complaints, ++complaints;
    const std::string name = arguments.wrong + "-" + std::to_string(number);
    keep(fs::path(arguments.output) / "findings" / name, folder, fuzzed, ended, *why);
    std::fprintf(stderr, "%s (%s): %s\n", name.c_str(), fuzzed.name.c_str(), why->c_str());
  }
  print(by_scene);
  return complaints == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Runs the programs on input with errors; runs with complaints are kept in OUTPUT/findings.\n"
      "Example: fuzz-runs logs --count 5000 -o out/fuzz");
  app.add_option("wrong", arguments.wrong, "the input with errors: logs, maps, inis or folders")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(fuzz::kNamesOfWrong.begin(), fuzz::kNamesOfWrong.end())));
  app.add_option("-o,--output", arguments.output, "output folder")->required();
  app.add_option("--first", arguments.first, "number of the first run (1)");
  app.add_option("--count", arguments.count, "number of runs (100)");
  app.add_option("--seconds", arguments.seconds, "no run begins after this time; 0: no limit (0)");
  app.add_option("--longest", arguments.bounds.seconds, "longest time of a run [s] (30)");
  app.add_option("--memory", arguments.bounds.mib, "most memory of a run [MiB] (2048)");
  app.add_option("--programs", arguments.programs, "folder of the programs; default: that of this program");
  CLI11_PARSE(app, argc, argv);
  if (arguments.programs.empty()) arguments.programs = fs::read_symlink("/proc/self/exe").parent_path();
  try {
    obs::registerClasses();
    return run(arguments);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "fuzz-runs: %s\n", error.what()), 1;
  }
}
