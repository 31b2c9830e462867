// Robustness against data for which nothing was tuned: every available 2D laser log, unchanged and in its other
// variants (reversed, thinned, without or with bad wheels, with a narrow laser, from the middle on), is mapped with one
// INI. Prints a Markdown table of absolute trajectory errors and writes a CSV with all results. --before adds the
// errors of an earlier CSV that differ.
//
// A map is wrong if its error is more than 1 m. UntunedLogs.h describes the references.
//
// Example: bench-robustness -o out/robustness
#include <omnimapper/eval/RelativePoseError.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/testing/ChildProgram.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "UntunedLogs.h"

namespace {

using namespace omnimapper;
namespace tests = omnimapper::testing;
using tests::LogVariant;
using untuned::Log;
namespace fs = std::filesystem;

struct Run {
  Run(const Log& of, LogVariant as) : log(&of), variant(as) {}

  const Log* log;
  LogVariant variant;
  int code = -1;
  double seconds = 0, ate = NAN, relative_10 = NAN, relative_50 = NAN;  // [m]
  std::size_t key_frames = 0, closures = 0, refused = 0;
  std::string verdict;

  // A run without a map counts neither as wrong nor as right.
  bool isMapped() const { return std::isfinite(ate); }
  bool isWrong() const { return isMapped() && ate > untuned::kWrong; }
};

double relativeError(const eval::Trajectory& estimate, const eval::Trajectory& reference, double travel) {
  try {
    return eval::relativePoseError(estimate, reference, untuned::pairing(), {travel, eval::DeltaUnit::metres})
        .translation.rmse;
  } catch (const base::Error&) {
    return NAN;  // the log is shorter than that
  }
}

void judge(Run& run, const std::string& folder, const eval::Trajectory& truth) {
  try {
    const auto ours = eval::readTum(folder + "/trajectory.tum");
    run.ate = untuned::errorOf(ours, truth);
    run.relative_10 = relativeError(truth, ours, 10);
    run.relative_50 = relativeError(truth, ours, 50);
    const auto summary = nlohmann::json::parse(std::ifstream(folder + "/summary.json"));
    run.key_frames = summary.at("key_frames");
    run.closures = summary.at("closures").at("accepted");
    run.refused = summary.at("closures").at("refused");
    if (summary.contains("verdict")) run.verdict = summary.at("verdict").at("verdict");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", folder.c_str(), error.what());
  }
}

std::string key(const Run& run) {
  return run.log->name + "," + tests::nameOf(run.variant);
}

std::string errorOf(const Run& run) {
  char text[80];
  if (!run.isMapped()) {
    std::snprintf(text, sizeof text, "exit %d", run.code);
  } else {
    std::snprintf(text, sizeof text, run.isWrong() ? "**%.2f**" : "%.3f", run.ate);
  }
  return text;
}

std::string cell(const Run& run) {
  return errorOf(run) + (run.verdict.empty() || run.verdict == "consistent" ? "" : " (" + run.verdict + ")");
}

std::map<std::string, std::string> errorsIn(const std::string& csv) {
  std::map<std::string, std::string> errors;
  std::ifstream in(csv);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::stringstream words(line);
    std::string log, variant, error;
    if (std::getline(words, log, ',') && std::getline(words, variant, ',') && std::getline(words, error, ','))
      errors[log + "," + variant] = error;
  }
  return errors;
}

void printTable(const std::vector<Run>& runs, const std::vector<Log>& logs, const std::vector<LogVariant>& variants,
                const std::map<std::string, std::string>& before) {
  std::printf("| log |");
  for (const auto variant : variants) std::printf(" %s |", tests::nameOf(variant).c_str());
  std::printf("\n|---|%s\n",
              [&] {
                std::string rule;
                for (std::size_t i = 0; i < variants.size(); ++i) rule += "---|";
                return rule;
              }()
                  .c_str());
  const auto row = [&](const std::string& name, const auto& cell_of) {
    std::printf("| %s |", name.c_str());
    for (const auto variant : variants) std::printf(" %s |", cell_of(variant).c_str());
    std::printf("\n");
  };
  for (const auto& log : logs) {
    row(log.name, [&](LogVariant variant) -> std::string {
      for (const auto& run : runs) {
        if (run.log != &log || run.variant != variant) continue;
        const auto was = before.find(key(run));
        return cell(run) + (was == before.end() || was->second == errorOf(run) ? "" : ", was " + was->second);
      }
      return "";
    });
  }
  const auto over = [&](LogVariant variant, const auto& pick) -> std::string {
    std::vector<double> errors;
    for (const auto& run : runs) {
      if (run.variant == variant && run.isMapped()) errors.push_back(run.ate);
    }
    if (errors.empty()) return "";
    std::sort(errors.begin(), errors.end());
    char text[40];
    std::snprintf(text, sizeof text, "%.3f", pick(errors));
    return text;
  };
  row("*median*", [&](LogVariant v) { return over(v, [](const auto& e) { return e[e.size() / 2]; }); });
  row("*worst*", [&](LogVariant v) { return over(v, [](const auto& e) { return e.back(); }); });
}

void printCounts(const std::vector<Run>& runs) {
  std::size_t wrong = 0, unmapped = 0, wrong_unsaid = 0, good_suspicious = 0, good_unsure = 0;
  double seconds = 0;
  for (const auto& run : runs) {
    wrong += run.isWrong();
    unmapped += !run.isMapped();
    wrong_unsaid += run.isWrong() && run.verdict != "suspicious" && run.verdict != "cannot tell";
    good_suspicious += run.isMapped() && !run.isWrong() && run.verdict == "suspicious";
    good_unsure += run.isMapped() && !run.isWrong() && run.verdict == "cannot tell";
    seconds += run.seconds;
  }
  std::printf(
      "\n%zu maps: %zu good, of which %zu called suspicious and %zu \"cannot tell\"; %zu wrong (over %.0f m), of which "
      "%zu "
      "called consistent; %zu without a map. %.0f s of mapping.\n",
      runs.size(), runs.size() - wrong - unmapped, good_suspicious, good_unsure, wrong, untuned::kWrong, wrong_unsaid,
      unmapped, seconds);
}

void writeCsv(const std::string& path, const std::vector<Run>& runs) {
  std::ofstream csv(path);
  csv << "log,variant,error,exit,ate_m,relative_10_m,relative_50_m,key_frames,closures,refused,verdict,seconds\n";
  for (const auto& run : runs) {
    csv << key(run) << "," << errorOf(run) << "," << run.code << "," << run.ate << "," << run.relative_10 << ","
        << run.relative_50 << "," << run.key_frames << "," << run.closures << "," << run.refused << "," << run.verdict
        << "," << run.seconds << "\n";
  }
}

template <class Item, class Name>
void keepNamed(std::vector<Item>& items, const std::vector<std::string>& names, const Name& name_of) {
  if (names.empty()) return;
  items.erase(std::remove_if(items.begin(), items.end(),
                             [&](const Item& item) {
                               return std::find(names.begin(), names.end(), name_of(item)) == names.end();
                             }),
              items.end());
}

}  // namespace

int main(int argc, char** argv) {
  std::string ini = tests::sourceFile("ini/laser2d.ini"), out, before;
  std::vector<std::string> names, variant_names, settings;
  int jobs = 2;
  CLI::App app("Maps every available 2D laser log in several variants and prints the errors of the maps.");
  app.add_option("-i,--ini", ini, "INI of the mapper (ini/laser2d.ini)");
  app.add_option("-o,--output", out,
                 "folder for logs, maps and results.csv; logs that are there already are used again")
      ->required();
  app.add_option("--logs", names, "only these logs")->delimiter(',');
  app.add_option("--variants", variant_names, "only these variants")->delimiter(',');
  app.add_option("--set", settings, "section.key=value");
  app.add_option("--jobs", jobs, "number of maps that are made at the same time")->check(CLI::PositiveNumber);
  app.add_option("--before", before, "results.csv of an earlier run; errors that differ from it are shown")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  obs::registerClasses();
  const auto errors_before = before.empty() ? std::map<std::string, std::string>{} : errorsIn(before);

  auto logs = untuned::logsAtHand(out);
  keepNamed(logs, names, [](const Log& log) { return log.name; });
  auto variants = tests::allLogVariants();
  keepNamed(variants, variant_names, tests::nameOf);

  struct Running {
    std::size_t run;
    std::string folder;
    eval::Trajectory truth;
    std::unique_ptr<tests::Program> program;
  };
  std::vector<Run> runs;
  std::deque<Running> running;
  const auto finishOne = [&] {
    const auto ended = running.front().program->wait();
    Run& run = runs[running.front().run];
    run.code = ended.code;
    run.seconds = ended.seconds;
    if (ended.code != 0 && ended.code != 17)
      std::fprintf(stderr, "%s: %s\n", key(run).c_str(), toString(ended).c_str());
    judge(run, running.front().folder, running.front().truth);
    running.pop_front();
  };
  for (const auto& log : logs) {
    std::optional<untuned::Observations> observations;
    for (const auto variant : variants) {
      const bool thins = variant == LogVariant::every_second_scan || variant == LogVariant::every_fourth_scan;
      if (log.is_thin && thins) continue;
      const std::string folder = out + "/" + log.name + "/" + tests::nameOf(variant), path = folder + "/log.rawlog";
      if (!observations) observations = untuned::read(log);
      if (!fs::exists(path)) {
        fs::create_directories(folder);
        untuned::writeVariant(*observations, variant, path);
      }
      const auto command = untuned::mappingCommand(ini, path, folder, settings);
      if (running.size() == static_cast<std::size_t>(jobs)) finishOne();
      fs::remove(folder + "/trajectory.tum");
      runs.emplace_back(log, variant);
      running.push_back({runs.size() - 1, folder, untuned::truthOf(log, *observations, variant),
                         std::make_unique<tests::Program>(command, tests::ProgramOptions{600, 0})});
    }
  }
  while (!running.empty()) finishOne();
  writeCsv(out + "/results.csv", runs);
  printTable(runs, logs, variants, errors_before);
  printCounts(runs);
}
