#pragma once

#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/RelativePoseError.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A combination of data sources and methods by which a log is mapped.
struct AblationVariant {
  enum class Family { visual, clouds };
  std::string key;  ///< name on the command line, in the CSV and of output folders
  Family family;
  std::string title;                  ///< within its family
  std::vector<std::string> settings;  ///< section.key=value

  std::string fullTitle() const { return (family == Family::visual ? "visual: " : "clouds: ") + title; }
};

/// Result of one variant on one log.
struct AblationRun {
  std::string log;       ///< its name
  std::string variant;   ///< its key
  double ate = NAN;      ///< [m] root mean square after the best rigid alignment
  double largest = NAN;  ///< [m]
  double drift = NAN;    ///< [m] over `span`, root mean square; NaN if no two poses are a span apart
  eval::Delta span;
  double travel = NAN;  ///< [m] travelled along the log's true trajectory
  std::string verdict;
  double processor_seconds = 0;
  std::string failure;  ///< why there is no map; empty if there is one

  bool isMapped() const { return failure.empty(); }
  bool isSuspicious() const { return verdict == "suspicious"; }
};

/// "0.4 % of 10 m" or "17 mm in 1 s".
inline std::string driftText(const AblationRun& run) {
  if (!std::isfinite(run.drift)) return "";
  const std::string span = base::brief(run.span.value);
  if (run.span.unit == eval::DeltaUnit::seconds) return base::fixed(1000 * run.drift, 0) + " mm in " + span + " s";
  return base::fixed(100 * run.drift / run.span.value, 1) + " % of " + span + " m";
}

/// The text without characters that would end a line of the table or a cell.
inline std::string onOneLine(std::string text) {
  for (char& letter : text) {
    if (letter == '\n' || letter == '|') letter = ' ';
  }
  return text;
}

inline std::string markdownHeader() {
  return "| log | variant | ATE [m] | drift | largest error [m] | verdict | processor [s] "
         "|\n|---|---|---|---|---|---|---|\n";
}

/// A line of the table.
inline std::string markdownRow(const AblationRun& run, const std::string& title) {
  const std::string begin = "| " + run.log + " | " + title + " | ",
                    end = base::fixed(run.processor_seconds, 1) + " |\n";
  if (run.isMapped()) {
    return begin + base::fixed(run.ate, 3) + " | " + driftText(run) + " | " + base::fixed(run.largest, 3) + " | " +
           run.verdict + " | " + end;
  }
  return begin + "no map: " + onOneLine(run.failure) + " | | | | " + end;
}

inline void writeRuns(const std::string& path, const std::vector<AblationRun>& runs) {
  std::ofstream csv(path);
  csv << "log,variant,ate_m,largest_m,drift_m,span,span_unit,travel_m,verdict,processor_s,failure\n";
  for (const auto& run : runs) {
    csv << run.log << "," << run.variant << "," << run.ate << "," << run.largest << "," << run.drift << ","
        << run.span.value << "," << (run.span.unit == eval::DeltaUnit::seconds ? "s" : "m") << "," << run.travel << ","
        << run.verdict << "," << run.processor_seconds << "," << onOneLine(run.failure) << "\n";
  }
}

/// Reads the CSV that writeRuns() wrote.
inline std::vector<AblationRun> readRuns(const std::string& path) {
  std::vector<AblationRun> runs;
  std::ifstream csv(path);
  std::string line;
  std::getline(csv, line);
  while (std::getline(csv, line)) {
    std::stringstream words(line);
    const auto word = [&] {
      std::string text;
      std::getline(words, text, ',');
      return text;
    };
    AblationRun run;
    run.log = word();
    run.variant = word();
    run.ate = std::stod(word());
    run.largest = std::stod(word());
    run.drift = std::stod(word());
    run.span.value = std::stod(word());
    run.span.unit = eval::deltaUnitNamed(word());
    run.travel = std::stod(word());
    run.verdict = word();
    run.processor_seconds = std::stod(word());
    std::getline(words, run.failure);
    runs.push_back(run);
  }
  return runs;
}

}  // namespace omnimapper::bench
