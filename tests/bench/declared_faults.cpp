// Whether faults of recordings are found and named by omnimapper-graphslam --check: parts of the logs at hand, and logs
// of simulated places with and without a depth camera, are checked unchanged and with each fault of DeclaredFaults.h in
// all its grades. A fault is named if a finding on its kind is among the findings; a finding on another contradiction
// is a wrong cause. --maps maps each log that has truth.tum beside it unchanged, with the fault, and with the proposed
// check.ini. --write writes the logs with faults. --amounts prints what was measured for faults that have an amount.
//
// Example: bench-declared_faults --log aces.rawlog --log home.rawlog --seconds 120
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/check/CheckRun.h>
#include <omnimapper/check/gatherFacts.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/DeclaredFaults.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MemorySource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace {

using namespace omnimapper;
namespace fs = std::filesystem;
namespace tests = omnimapper::testing;
using tests::DeclaredFault;
using tests::Fault;
using tests::MemorySource;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

struct Part {
  std::string name;
  Observations log;
  bool has_camera = false;
  std::string truth;  // file; empty if there is none
};

// The words by which findings name a kind of fault.
std::vector<std::string> wordsOf(DeclaredFault kind) {
  switch (kind) {
    case DeclaredFault::laser_sense:
    case DeclaredFault::laser_roll:
    case DeclaredFault::wheels_left_right:
      return {"turns right", "is mounted upside down", "is reversed"};
    case DeclaredFault::laser_yaw:
      return {"mounted otherwise", "looks backwards",
              "its sensor pose is missing: in the log it is at the origin of the "
              "base; according"};
    case DeclaredFault::range_limit:
    case DeclaredFault::maximum_readings:
      return {"measure exactly", "single beams at the maximum range"};
    case DeclaredFault::frozen_scans:
      return {"exactly equal to the one before"};
    case DeclaredFault::wheels_clock:
    case DeclaredFault::camera_clock:
      return {"clocks differ", "do their clocks differ"};
    case DeclaredFault::camera_yaw:
    case DeclaredFault::camera_roll:
      return {"against its declared pose"};
    case DeclaredFault::depth_scale:
      return {"true depths are", "another unit"};
    case DeclaredFault::focal_length:
      return {"true focal length"};
    case DeclaredFault::mirrored_images:
      return {"mirror images"};
    case DeclaredFault::ranges_as_depths:
      return {"distances from the camera"};
    case DeclaredFault::stamps:
      return {"[source] step_s"};
  }
  return {};
}

struct Outcome {
  bool is_named = false, has_wrong_cause = false, is_problem = false;
  std::vector<std::string> texts;  // of contradictions
};

Outcome outcomeOf(const check::LogFacts& facts, const std::vector<std::string>& words,
                  const std::set<std::string>& usual) {
  Outcome outcome;
  for (const auto& finding : check::judge(facts)) {
    const auto said = [&](const std::string& some) { return finding.text.find(some) != std::string::npos; };
    const bool names = std::any_of(words.begin(), words.end(), said);
    outcome.is_named = outcome.is_named || names;
    outcome.is_problem = outcome.is_problem || finding.weight == check::Weight::problem;
    if (names || finding.weight == check::Weight::note || !finding.is_contradiction) continue;
    if (usual.count(finding.text) > 0) continue;
    outcome.has_wrong_cause = true;
    outcome.texts.push_back(finding.text);
  }
  return outcome;
}

std::vector<Part> partsOf(const std::string& path, double seconds) {
  constexpr double kLeastTravel = 8;  // [m]
  const auto log = source::openLogs({path}, {});
  std::vector<Part> parts;
  base::Stamp begin;
  while (const auto observation = log->next()) {
    if (!base::isValid(observation->timestamp)) continue;
    if (parts.empty() || base::secondsBetween(begin, observation->timestamp) > seconds) {
      begin = observation->timestamp;
      parts.push_back({fs::path(path).stem().string() + " " + std::to_string(parts.size()), {}, false, ""});
    }
    parts.back().log.push_back(observation);
    parts.back().has_camera =
        parts.back().has_camera || dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(observation.get());
  }
  const auto stands = [&](const Part& part) {
    MemorySource source(part.log);
    double travel = 0;
    for (const auto& [label, odometry] : check::gatherFacts(source).odometry)
      travel = std::max(travel, odometry.travel);
    return travel < kLeastTravel;
  };
  parts.erase(std::remove_if(parts.begin(), parts.end(), stands), parts.end());
  const std::string truth = fs::path(path).parent_path() / "truth.tum";
  for (auto& part : parts) {
    if (fs::exists(truth)) part.truth = truth;
    std::stable_sort(part.log.begin(), part.log.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  }
  return parts;
}

// What was measured of a fault, in its unit.
std::string measuredOf(const check::LogFacts& facts, const Fault& fault) {
  char text[120] = "";
  const auto print = [&](double value, double sigma) {
    std::snprintf(text, sizeof text, "%.4g +- %.2g", value, sigma);
  };
  const double degree = base::option_text::kRadiansPerDegree;
  if (fault.kind == DeclaredFault::wheels_clock && !facts.motions.empty() && facts.motions.front().clock)
    print(facts.motions.front().clock->offset, facts.motions.front().clock->sigma);
  if (fault.kind == DeclaredFault::laser_yaw && !facts.motions.empty() && facts.motions.front().mounting)
    print(-facts.motions.front().mounting->yaw / degree, facts.motions.front().mounting->yaw_sigma / degree);
  if (facts.cameras.empty()) return text;
  const auto& camera = facts.cameras.front();
  if (fault.kind == DeclaredFault::camera_yaw && camera.yaw)
    print(-camera.yaw->value / degree, camera.yaw->sigma / degree);
  if (fault.kind == DeclaredFault::camera_clock && camera.clock) print(camera.clock->value, camera.clock->sigma);
  if (fault.kind == DeclaredFault::depth_scale && camera.scale)
    print(1 / camera.scale->value, camera.scale->sigma / (camera.scale->value * camera.scale->value));
  if (fault.kind == DeclaredFault::focal_length && camera.focal)
    print(1 / camera.focal->value, camera.focal->sigma / camera.focal->value);
  return text;
}

std::string fileNameOf(const Part& part, const Fault& fault) {
  char amount[40];
  std::snprintf(amount, sizeof amount, "%g", fault.amount);
  std::string name = part.name + "_" + tests::nameOf(fault.kind) + "_" + amount + ".rawlog";
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '\''; }, '_');
  return name;
}

void write(const Observations& log, const std::string& path) {
  source::writeRawlog(path, [&](source::RawlogWriter& writer) {
    for (const auto& observation : log) writer.add(*observation);
  });
}

// The errors of three maps of a log with truth.tum beside it: unchanged, with a fault, and with the fault and the
// proposed check.ini.
class Maps {
 public:
  Maps(std::string folder, const Part& part)
      : folder_(std::move(folder)),
        truth_(eval::readTum(part.truth)),
        ini_(tests::sourceFile(part.has_camera ? "ini/home_planes.ini" : "ini/laser2d.ini")) {
    fs::create_directories(folder_);
    unchanged_ = errorOf(part.log, "");
  }

  void compare(const Part& part, const Fault& fault) {
    const auto log = tests::withFault(part.log, fault);
    const double with_fault = errorOf(log, "");
    base::Progress quiet;
    const auto checked =
        check::runCheck({rawlog()}, base::Config::fromFile(ini_), folder_, quiet, [] { return false; });
    const double mended = errorOf(log, folder_ + "/check.ini");
    const bool is_bad = !(with_fault < unchanged_ + 0.3), is_good = with_fault < unchanged_ + 0.05;
    const bool says_15 = checked.code == base::ExitCode::doubtful_input;
    std::printf("MAP %s, %s %g: %.3f %.3f %.3f %d%s%s%s\n", part.name.c_str(), tests::nameOf(fault.kind).c_str(),
                fault.amount, unchanged_, with_fault, mended, static_cast<int>(checked.code),
                is_bad && !says_15 ? " UNSAID" : "", is_good && says_15 ? " NEEDLESS" : "",
                mended > 1.3 * unchanged_ + 0.01 ? " NOT MENDED" : "");
    std::fflush(stdout);
  }

 private:
  std::string rawlog() const { return folder_ + "/log.rawlog"; }

  // [m] NaN if there is no map.
  double errorOf(const Observations& log, const std::string& more) const {
    write(log, rawlog());
    fs::remove_all(folder_ + "/map");
    try {
      auto config =
          base::Config::fromFiles(more.empty() ? std::vector<std::string>{ini_} : std::vector<std::string>{ini_, more});
      config.set("mapper.output_plugins=map,trajectory,summary");
      mapper::RunRequest request;
      request.logs = {rawlog()};
      request.output_folder = folder_ + "/map";
      base::Progress quiet;
      mapper::runMapping(request, config, quiet, [] { return false; });
      eval::PairingOptions pairing;
      pairing.alignment = eval::Alignment::yaw;
      return eval::absoluteTrajectoryError(eval::readTum(folder_ + "/map/trajectory.tum"), truth_, pairing)
          .translation.rmse;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return NAN;
    }
  }

  std::string folder_;
  eval::Trajectory truth_;
  std::string ini_;
  double unchanged_ = NAN;
};

struct Row {
  int cases = 0, named = 0, gross = 0, gross_named = 0, wrong_alone = 0, gross_wrong_alone = 0;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> logs;
  double seconds = 120;
  bool print_amounts = false, is_verbose = false;
  std::vector<std::string> only;
  std::string maps, written;
  CLI::App app("Checks logs with known faults.");
  app.add_option("--log", logs, "rawlogs")->required();
  app.add_option("--seconds", seconds, "length of a part of a log");
  app.add_option("--only", only, "names of kinds of faults")->delimiter(',');
  app.add_option("--maps", maps, "folder in which logs with truth.tum beside them are mapped, instead of the table");
  app.add_option("--write", written, "folder into which the logs with faults are written");
  app.add_flag("--amounts", print_amounts, "print what was measured");
  app.add_flag("-v", is_verbose, "print each wrong cause and each missed fault");
  CLI11_PARSE(app, argc, argv);
  obs::registerClasses();
  mapper::loadFeatures();

  std::map<DeclaredFault, Row> rows;
  int unchanged = 0, alarms = 0;
  for (const auto& path : logs) {
    for (const auto& part : partsOf(path, seconds)) {
      std::optional<Maps> mapped;
      if (!maps.empty() && part.truth.empty()) continue;
      if (!maps.empty()) mapped.emplace(maps, part);
      MemorySource source(part.log);
      const auto plain = check::gatherFacts(source);
      std::set<std::string> usual;
      for (const auto& finding : check::judge(plain)) usual.insert(finding.text);
      const auto quiet = outcomeOf(plain, {}, {});
      ++unchanged;
      alarms += quiet.has_wrong_cause;
      for (const auto& text : quiet.texts) std::printf("ALARM %s: %s\n", part.name.c_str(), text.c_str());
      for (const auto kind : tests::allDeclaredFaults()) {
        if (tests::isOfCamera(kind) && !part.has_camera) continue;
        if (!only.empty() && std::find(only.begin(), only.end(), tests::nameOf(kind)) == only.end()) continue;
        for (const auto& fault : tests::gradesOf(kind)) {
          if (mapped) {
            mapped->compare(part, fault);
            continue;
          }
          const auto log = tests::withFault(part.log, fault);
          if (!written.empty()) write(log, written + "/" + fileNameOf(part, fault));
          MemorySource faulty(log);
          const auto facts = check::gatherFacts(faulty);
          const auto outcome = outcomeOf(facts, wordsOf(kind), usual);
          auto& row = rows[kind];
          ++row.cases;
          row.named += outcome.is_named;
          row.gross += fault.is_gross;
          row.gross_named += fault.is_gross && outcome.is_named;
          const bool is_wrong_alone = outcome.has_wrong_cause && !outcome.is_named;
          row.wrong_alone += is_wrong_alone;
          row.gross_wrong_alone += fault.is_gross && is_wrong_alone;
          if (print_amounts)
            std::printf("%s, %s %g: %s %s\n", part.name.c_str(), tests::nameOf(kind).c_str(), fault.amount,
                        measuredOf(facts, fault).c_str(), outcome.is_named ? "named" : "-");
          if (!is_verbose) continue;
          if (fault.is_gross && !outcome.is_named)
            std::printf("MISSED %s, %s %g\n", part.name.c_str(), tests::nameOf(kind).c_str(), fault.amount);
          for (const auto& text : outcome.texts)
            std::printf("WRONG %s, %s %g: %s\n", part.name.c_str(), tests::nameOf(kind).c_str(), fault.amount,
                        text.c_str());
        }
      }
      std::fflush(stdout);
    }
  }
  std::printf(
      "\n| fault | gross: cases | named | another cause alone | little: cases | named | another cause alone |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const auto& [kind, row] : rows) {
    std::printf("| %s | %d | %d | %d | %d | %d | %d |\n", tests::nameOf(kind).c_str(), row.gross, row.gross_named,
                row.gross_wrong_alone, row.cases - row.gross, row.named - row.gross_named,
                row.wrong_alone - row.gross_wrong_alone);
  }
  std::printf("\n%d unchanged logs, %d of them with a false alarm.\n", unchanged, alarms);
}
