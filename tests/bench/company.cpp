// Drives in company and through bare corridors: whether who walks along, or a wall that looks the same everywhere,
// moves the map. Simulated with other seeds than those on which anything was chosen, and mapped with one INI.
//
// corridor: a corridor of 44 m, alone and with people. The largest error along it may be 1.2 times that of the wheels,
//   with the true heading given, and 5 cm.
// bare: corridors of 30, 60 and 120 m without any door, there and back, with five lasers; the same bar.
// plans: generated places with people, against the same log without: the ratio of the absolute trajectory errors.
//
// Example: bench-company -o out/company --seeds 10
#include <omnimapper/obs/registerClasses.h>

#include <CLI/CLI.hpp>
#include <map>

#include "CompanyLogs.h"

namespace {

using namespace company;

struct Options {
  std::string out, ini;
  int seeds = 10, first_seed = 101;
  Settings settings;
};

struct Kind {
  std::string name;
  Settings settings;
};

struct Result {
  double error, wheels, heading;
  std::string verdict;
  bool isGood() const { return error <= 1.2 * wheels + 0.05; }
};

std::optional<Result> judged(const Options& options, const std::string& name, const std::string& ini_text,
                             Settings settings, int seed) {
  const std::string ini = options.out + "/inis/" + name + ".ini";
  std::filesystem::create_directories(options.out + "/inis");
  std::ofstream(ini) << ini_text;
  settings.push_back("simulation.seed=" + std::to_string(seed));
  const std::string of_seed = name + "/" + std::to_string(seed);
  const auto log = simulated(options.out + "/logs/" + of_seed, ini, settings);
  if (!log) return std::nullopt;
  const auto map = mapped(*log, options.out + "/maps/" + of_seed, options.settings);
  if (!map) return std::nullopt;
  const auto truth = eval::readTum(log->reference);
  const auto largest = largestErrors(map->trajectory, truth);
  return Result{largest.along, wheelsError(*log, truth), largest.heading * 180 / M_PI, map->verdict};
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Prints a row of the table, and adds the heading errors to `alone` or compares them with it.
void printRow(const std::string& name, const std::vector<std::optional<Result>>& results, std::vector<double>& alone) {
  std::vector<double> errors, wheels, turned;
  std::size_t good = 0, wrong_and_sure = 0;
  double worst = 0;
  std::map<std::string, std::size_t> verdicts;
  const bool is_first = alone.empty();
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (is_first) alone.push_back(results[i] ? results[i]->heading : NAN);
    if (!results[i]) continue;
    const auto& result = *results[i];
    errors.push_back(result.error);
    wheels.push_back(result.wheels);
    turned.push_back(result.heading - alone[i]);
    good += result.isGood();
    worst = std::max(worst, result.error);
    wrong_and_sure += result.error > 1 && result.verdict == "consistent";
    ++verdicts[result.verdict];
  }
  std::printf("| %s | %zu of %zu | %.3f | %.3f | %.3f | %.2f | %zu, %zu, %zu | %zu |\n", name.c_str(), good,
              results.size(), medianOf(errors), worst, medianOf(wheels),
              turned.empty() ? NAN : *std::max_element(turned.begin(), turned.end()), verdicts["consistent"],
              verdicts["cannot tell"], verdicts["suspicious"], wrong_and_sure);
  std::fflush(stdout);
}

void printHead(const char* what) {
  std::printf(
      "\n| %s | within the bar | median error [m] | worst [m] | wheels, median [m] | heading worse than in the "
      "first row by up to [deg] | consistent, cannot tell, suspicious | consistent and over 1 m off |\n"
      "|---|---|---|---|---|---|---|---|\n",
      what);
}

void corridors(const Options& options) {
  const auto people = [](const std::string& names) { return "world.people=" + names; };
  const std::vector<Kind> kinds{
      {"alone", {}},
      {"one 0.7 m ahead", {people("anna"), "anna.distance_m=0.7"}},
      {"one 1.0 m ahead", {people("anna"), "anna.distance_m=1.0"}},
      {"one 1.5 m ahead", {people("anna"), "anna.distance_m=1.5"}},
      {"one beside", {people("dora")}},
      {"three ahead", {people("anna,ben,cleo")}},
      {"five around, from 30 to 35 s",
       {people("anna,ben,cleo,dora,emil"), "anna.from_s=30", "anna.until_s=35", "ben.from_s=30", "ben.until_s=35",
        "cleo.from_s=30", "cleo.until_s=35", "dora.from_s=30", "dora.until_s=35", "emil.from_s=30", "emil.until_s=35"}},
      {"five around, all the way", {people("anna,ben,cleo,dora,emil")}},
  };
  printHead("corridor of 44 m");
  std::vector<double> alone;
  for (const auto& kind : kinds) {
    std::vector<std::optional<Result>> results;
    for (int k = 0; k < options.seeds; ++k)
      results.push_back(judged(options, kind.name, kCorridor, kind.settings, options.first_seed + k));
    printRow(kind.name, results, alone);
  }
}

void bareCorridors(const Options& options) {
  const std::vector<std::pair<std::string, std::string>> lasers{
      {"LMS of 181 beams", "model = sick_lms291"},
      {"LMS of 361 beams", "model = sick_lms291\nbeams = 361"},
      {"UTM of 271 beams", "model = hokuyo_utm30\nbeams = 271"},
      {"UTM of 541 beams", "model = hokuyo_utm30\nbeams = 541"},
      {"UTM of 1081 beams", "model = hokuyo_utm30"}};
  printHead("bare corridor");
  for (const int length : {30, 60, 120}) {
    for (const auto& [name, laser] : lasers) {
      const std::string full = std::to_string(length) + " m, " + name;
      std::vector<double> alone;
      std::vector<std::optional<Result>> results;
      for (int k = 0; k < options.seeds; ++k)
        results.push_back(judged(options, full, bareCorridor(length, laser), {}, options.first_seed + k));
      printRow(full, results, alone);
    }
  }
}

// The absolute trajectory error [m] and the verdict of a generated place.
std::optional<std::pair<double, std::string>> errorOfPlan(const Options& options, const std::string& place, int plan,
                                                          const std::string& companions) {
  const std::string name = place + "/" + std::to_string(plan) + "/" + companions;
  const auto log =
      simulated(options.out + "/logs/" + name, omnimapper::testing::sourceFile("rawlogs/" + place + ".ini"),
                {"simulation.sensors=laser, odometry", "world.plan_seed=" + std::to_string(plan),
                 "world.companions=" + companions, "world.people=", "world.move_time_s=-1"});
  if (!log) return std::nullopt;
  const auto map = mapped(*log, options.out + "/maps/" + name, options.settings);
  if (!map) return std::nullopt;
  return std::pair(untuned::errorOf(map->trajectory, eval::readTum(log->reference)), map->verdict);
}

void plans(const Options& options, const std::vector<std::string>& places, int count) {
  std::printf("\n| plan | people | alone: ATE [m] | in company | ratio | verdict |\n|---|---|---|---|---|---|\n");
  const std::vector<std::string> people{"guide", "guests", "group", "crowd"};
  std::vector<double> ratios;
  std::size_t bad = 0;
  for (const auto& place : places) {
    for (int k = 0; k < count; ++k) {
      const int plan = options.first_seed + k;
      const auto& with = people[static_cast<std::size_t>(k) % people.size()];
      const auto alone = errorOfPlan(options, place, plan, "none"), company = errorOfPlan(options, place, plan, with);
      if (!alone || !company) continue;
      ratios.push_back(company->first / alone->first);
      const bool is_bad = company->first > 1.5 * alone->first + 0.02;
      bad += is_bad;
      std::printf("| %s %d | %s | %.4f | %s%.4f%s | %.2f | %s |\n", place.c_str(), plan, with.c_str(), alone->first,
                  is_bad ? "**" : "", company->first, is_bad ? "**" : "", ratios.back(), company->second.c_str());
      std::fflush(stdout);
    }
  }
  std::printf("\nMedian ratio %.2f of %zu plans; %zu are over 1.5 times and 2 cm.\n", medianOf(ratios), ratios.size(),
              bad);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::vector<std::string> parts{"corridor", "bare", "plans"}, places{"home", "office", "laboratory"};
  int plan_count = 7;
  CLI::App app("Maps simulated drives in company and through bare corridors, and prints how far off the maps are.");
  app.add_option("-o,--output", options.out, "folder for logs and maps; logs that are there already are used again")
      ->required();
  app.add_option("--parts", parts, "corridor, bare, plans")->delimiter(',');
  app.add_option("--places", places, "home, office, laboratory")->delimiter(',');
  app.add_option("--seeds", options.seeds, "number of seeds of each corridor");
  app.add_option("--plans", plan_count, "number of plans of each place");
  app.add_option("--first-seed", options.first_seed, "the first seed of corridors and plans");
  app.add_option("--set", options.settings, "section.key=value of the mapper");
  CLI11_PARSE(app, argc, argv);
  omnimapper::obs::registerClasses();
  for (const auto& part : parts) {
    if (part == "corridor") corridors(options);
    if (part == "bare") bareCorridors(options);
    if (part == "plans") plans(options, places, plan_count);
  }
  return 0;
}
