// Robots that are carried while nothing is recorded: whether the map is repaired, or the run says when it broke. Logs
// at hand are cut at random places; after a gap the robot goes on elsewhere, 1 to 10 m away and turned, and its wheels
// notice nothing. The same gaps without that, in which the robot stands or drives on, must not be suspected.
//
// Example: bench-carried -o out/carried
#include <omnimapper/obs/registerClasses.h>

#include <CLI/CLI.hpp>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "UntunedLogs.h"

namespace {

using namespace omnimapper;
namespace tests = omnimapper::testing;
namespace fs = std::filesystem;
using untuned::Observations;

enum class Kind { carried, standing, driving };

const char* nameOf(Kind kind) {
  return kind == Kind::carried ? "carried" : kind == Kind::standing ? "standing" : "driving";
}

struct Gap {
  base::Stamp from, to;
  double seconds, metres, degrees;
};

const eval::StampedPose& at(const eval::Trajectory& truth, base::Stamp stamp) {
  const auto found = std::lower_bound(truth.begin(), truth.end(), stamp,
                                      [](const auto& pose, base::Stamp wanted) { return pose.stamp < wanted; });
  return found == truth.end() ? truth.back() : *found;
}

// Where the robot is carried from and to, with at least a fifth of the log before and after.
Gap drawn(const eval::Trajectory& truth, std::mt19937& generator) {
  constexpr double kLeast = 1, kMost = 10;  // [m]
  std::uniform_real_distribution<double> share(0.2, 0.75), seconds(2, 20);
  const auto length = base::secondsBetween(truth.front().stamp, truth.back().stamp);
  for (;;) {
    const auto stampAt = [&](double part) { return truth.front().stamp + base::durationFromSeconds(part * length); };
    const auto &from = at(truth, stampAt(share(generator))), &to = at(truth, stampAt(share(generator)));
    const auto motion = geometry::inverse(from.world_from_body) * to.world_from_body;
    const double metres = motion.translation.norm();
    if (to.stamp <= from.stamp || metres < kLeast || metres > kMost) continue;
    return {from.stamp, to.stamp, seconds(generator), metres, geometry::project(motion).yaw * 180 / M_PI};
  }
}

Observations changed(const Observations& log, const Gap& gap, Kind kind) {
  const auto end = gap.from + base::durationFromSeconds(gap.seconds);
  if (kind != Kind::driving)
    return tests::carried(log, gap.from, kind == Kind::carried ? gap.to : gap.from, gap.seconds);
  Observations rest;
  std::copy_if(log.begin(), log.end(), std::back_inserter(rest),
               [&](const auto& one) { return one->timestamp <= gap.from || one->timestamp >= end; });
  return rest;
}

eval::Trajectory changed(const eval::Trajectory& truth, const Gap& gap, Kind kind) {
  if (kind == Kind::driving) return truth;
  const auto to = kind == Kind::carried ? gap.to : gap.from;
  const auto later = gap.from + base::durationFromSeconds(gap.seconds) - to;
  eval::Trajectory rest;
  for (const auto& pose : truth) {
    if (pose.stamp <= gap.from) rest.push_back(pose);
  }
  for (auto pose : truth) {
    if (pose.stamp < to || pose.stamp <= gap.from) continue;
    pose.stamp += later;
    rest.push_back(pose);
  }
  return rest;
}

}  // namespace

int main(int argc, char** argv) {
  std::string ini = tests::sourceFile("ini/laser2d.ini"), out;
  std::vector<std::string> settings, names;
  int each = 3, seed = 1;
  CLI::App app("Maps logs in which the robot is carried, stands or drives while nothing is recorded.");
  app.add_option("-o,--output", out, "folder for logs and maps")->required();
  app.add_option("-i,--ini", ini, "INI of the mapper (ini/laser2d.ini)");
  app.add_option("--logs", names, "only these logs")->delimiter(',');
  app.add_option("--each", each, "number of gaps in each log");
  app.add_option("--seed", seed, "of the places of the gaps");
  app.add_option("--set", settings, "section.key=value");
  CLI11_PARSE(app, argc, argv);
  obs::registerClasses();
  std::mt19937 generator(static_cast<unsigned>(seed));
  std::printf(
      "| log | gap [s] | carried [m], [deg] | kind | error [m] | verdict | at %% | break said at [s] off "
      "|\n|---|---|---|---|---|---|---|---|\n");
  std::map<Kind, std::array<int, 4>> counts;  // maps, right, suspicious, consistent and 0.5 m off
  for (const auto& log : untuned::logsAtHand(out)) {
    if (log.name == "ual" || log.name == "driving_in_office" || log.is_thin) continue;
    if (!names.empty() && std::find(names.begin(), names.end(), log.name) == names.end()) continue;
    const auto observations = untuned::read(log);
    const auto truth = eval::readTrajectory(log.reference);
    for (int i = 0; i < each; ++i) {
      const Gap gap = drawn(truth, generator);
      for (const auto kind : {Kind::carried, Kind::standing, Kind::driving}) {
        const std::string folder =
            out + "/" + log.name + "/" + std::to_string(seed) + "_" + std::to_string(i) + "_" + nameOf(kind);
        fs::create_directories(folder);
        source::writeRawlog(folder + "/log.rawlog", [&](source::RawlogWriter& rawlog) {
          for (const auto& one : changed(observations, gap, kind)) rawlog.add(*one);
        });
        const auto command = untuned::mappingCommand(ini, folder + "/log.rawlog", folder, settings);
        fs::remove(folder + "/trajectory.tum");
        const auto ended = tests::runProgram(command, {600, 0});
        double error = NAN, off = NAN;
        std::string verdict = "exit " + std::to_string(ended.code);
        try {
          error = untuned::errorOf(eval::readTum(folder + "/trajectory.tum"), changed(truth, gap, kind));
          const auto summary = nlohmann::json::parse(std::ifstream(folder + "/summary.json"));
          verdict = summary.at("verdict").at("verdict");
          const double begun = base::secondsBetween(observations.front()->timestamp, gap.from);
          const auto& evidence = summary.at("verdict").at("evidence");
          if (evidence.contains("broken_after_s")) {
            const auto& said = evidence.at("broken_after_s");
            for (const double seconds :
                 said.is_array() ? said.get<std::vector<double>>() : std::vector<double>{said.get<double>()}) {
              if (!(std::abs(seconds - begun) > std::abs(off))) off = seconds - begun;
            }
          }
        } catch (const std::exception& problem) {
          std::fprintf(stderr, "%s: %s\n", folder.c_str(), problem.what());
        }
        auto& count = counts[kind];
        ++count[0];
        count[1] += error < 0.5;
        count[2] += verdict == "suspicious";
        count[3] += error >= 0.5 && verdict == "consistent";
        std::printf("| %s | %.1f | %.1f, %.0f | %s | %.3f | %s | %.0f | %.1f |\n", log.name.c_str(), gap.seconds,
                    gap.metres, gap.degrees, nameOf(kind), error, verdict.c_str(),
                    100 * base::secondsBetween(truth.front().stamp, gap.from) /
                        base::secondsBetween(truth.front().stamp, truth.back().stamp),
                    off);
        std::fflush(stdout);
      }
    }
  }
  for (const auto& [kind, count] : counts)
    std::printf("%s: %d maps, %d within 0.5 m, %d suspicious, %d consistent but 0.5 m off\n", nameOf(kind), count[0],
                count[1], count[2], count[3]);
}
