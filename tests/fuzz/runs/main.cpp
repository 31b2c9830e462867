// Runs the programs of the project on logs, maps, INIs and folders that are wrong in ways that bytes alone would not
// be: values, stamps, labels, order, numbers under checksums that fit. complaint() has what a run must not do. Each
// trial is made of its number alone, so that it can be run again.
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

#include "Trials.h"

namespace {

using namespace omnimapper;
namespace fs = std::filesystem;

struct Arguments {
  std::string wrong, output, programs;
  std::uint64_t first = 1, count = 100;
  double seconds = 0;
  fuzz::Bounds bounds;
};

// How the trials of one scene ended.
struct Tally {
  std::size_t trials = 0, complaints = 0;
  double most_seconds = 0, most_mib = 0;
  std::map<std::string, std::size_t> ends;  // exit codes and signals
};

void add(const testing::Ended& ended, Tally& tally) {
  ++tally.trials;
  ++tally.ends[ended.signal != 0 ? "signal " + std::to_string(ended.signal) : std::to_string(ended.code)];
  tally.most_seconds = std::max(tally.most_seconds, ended.seconds);
  tally.most_mib = std::max(tally.most_mib, ended.peak_mib);
}

void keep(const fs::path& kept, const fs::path& folder, const fuzz::Trial& trial, const testing::Ended& ended,
          const std::string& why) {
  fs::remove_all(kept);
  fs::create_directories(kept.parent_path());
  fs::copy(folder, kept, fs::copy_options::recursive);
  std::ofstream out(kept / "trial.txt");
  out << why << "\n";
  for (const auto& word : trial.command) out << word << " ";
  out << "\n" << toString(ended) << "\n";
}

void print(const std::map<std::string, Tally>& tallies) {
  std::printf(
      "| scene | trials | complaints | longest [s] | most memory [MiB] | exit codes (times) "
      "|\n|---|---|---|---|---|---|\n");
  Tally all;
  for (const auto& [name, tally] : tallies) {
    std::string ends;
    for (const auto& [end, times] : tally.ends)
      ends += (ends.empty() ? "" : ", ") + end + " (" + std::to_string(times) + ")";
    std::printf("| %s | %zu | %zu | %.1f | %.0f | %s |\n", name.c_str(), tally.trials, tally.complaints,
                tally.most_seconds, tally.most_mib, ends.c_str());
    all.trials += tally.trials;
    all.complaints += tally.complaints;
    all.most_seconds = std::max(all.most_seconds, tally.most_seconds);
    all.most_mib = std::max(all.most_mib, tally.most_mib);
  }
  std::printf("| all | %zu | %zu | %.1f | %.0f | |\n", all.trials, all.complaints, all.most_seconds, all.most_mib);
}

int run(const Arguments& arguments) {
  const auto kind = std::find(fuzz::kNamesOfWrong.begin(), fuzz::kNamesOfWrong.end(), arguments.wrong);
  const auto wrong = static_cast<fuzz::Wrong>(kind - fuzz::kNamesOfWrong.begin());
  const std::string shared = arguments.output + "/shared", folder = arguments.output + "/trial";
  fs::remove_all(shared);
  fs::create_directories(shared);
  const fuzz::Trials trials(wrong, fs::absolute(arguments.programs), fs::absolute(shared));
  const auto start = std::chrono::steady_clock::now();
  const auto isOver = [&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return arguments.seconds > 0 && passed.count() > arguments.seconds;
  };
  std::map<std::string, Tally> tallies;
  std::size_t complaints = 0;
  for (std::uint64_t i = 0; i < arguments.count && !isOver(); ++i) {
    const std::uint64_t number = arguments.first + i;
    const auto trial = trials.make(number, fs::absolute(folder));
    const auto ended = testing::runProgram(trial.command, {arguments.bounds.seconds + 1});
    auto& tally = tallies[trial.name];
    add(ended, tally);
    const auto why = fuzz::complaint(ended, arguments.bounds);
    if (!why) continue;
    ++tally.complaints, ++complaints;
    const std::string name = arguments.wrong + "-" + std::to_string(number);
    keep(fs::path(arguments.output) / "findings" / name, folder, trial, ended, *why);
    std::fprintf(stderr, "%s (%s): %s\n", name.c_str(), trial.name.c_str(), why->c_str());
  }
  print(tallies);
  return complaints == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Runs the programs on what is wrong; findings are kept in OUTPUT/findings.\n"
      "Example: fuzz-runs logs --count 5000 -o out/fuzz");
  app.add_option("wrong", arguments.wrong, "logs, maps, inis or folders")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(fuzz::kNamesOfWrong.begin(), fuzz::kNamesOfWrong.end())));
  app.add_option("-o,--output", arguments.output, "folder")->required();
  app.add_option("--first", arguments.first, "number of the first trial (1)");
  app.add_option("--count", arguments.count, "so many trials (100)");
  app.add_option("--seconds", arguments.seconds, "no trial begins after so long; 0: all are run (0)");
  app.add_option("--longest", arguments.bounds.seconds, "seconds that a trial may take (30)");
  app.add_option("--memory", arguments.bounds.mib, "MiB that a trial may take (2048)");
  app.add_option("--programs", arguments.programs, "folder of the programs; default: this one's own");
  CLI11_PARSE(app, argc, argv);
  if (arguments.programs.empty()) arguments.programs = fs::read_symlink("/proc/self/exe").parent_path();
  try {
    obs::registerClasses();
    return run(arguments);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "fuzz-runs: %s\n", error.what()), 1;
  }
}
