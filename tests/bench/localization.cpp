// Halves of logs that are localized in the map of the other half, from any place or from wrong starts; and logs in the
// map of another place. Each located pose is compared with the map of the whole log, relative to the nearest key frame
// of the half that was mapped, so that bends of the maps do not count. Prints a Markdown table.
//
// Example: bench-localization -i ini/laser2d.ini -r intel.rawlog -o out/localization
//          bench-localization -i ini/laser2d.ini -r aces.rawlog --wrong-starts 10 -o out/starts
//          bench-localization -i ini/laser2d.ini -r mit-csail.rawlog --in intel.rawlog -o out/elsewhere
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "LogParts.h"

namespace {

using namespace omnimapper;
using geometry::Se3;

struct Setup {
  std::string ini, log, other, out;
  std::vector<std::string> settings;
  int wrong_starts = 0;
  unsigned seed = 1;
  bool continues = false;
};

mapper::RunResult run(const Setup& setup, mapper::RunRequest request, const std::vector<std::string>& start) {
  auto config = base::Config::fromFile(setup.ini);
  for (const auto& setting : setup.settings) config.set(setting);
  config.set("mapper.output_plugins=map,trajectory,localization,summary");
  config.set("localization.class=LocalizationOutput");
  for (const auto& setting : start) config.set(setting);
  base::Progress quiet;
  return mapper::runMapping(request, config, quiet, [] { return false; });
}

void makeMap(const Setup& setup, const std::string& log, const std::string& folder) {
  mapper::RunRequest request;
  request.logs = {log};
  request.output_folder = folder;
  run(setup, request, {});
}

const eval::StampedPose* nearestInTime(const eval::Trajectory& all, base::Stamp stamp) {
  const auto nearest = eval::nearestPose(all, stamp, base::durationFromSeconds(0.05));
  return nearest ? &all[*nearest] : nullptr;
}

struct Estimate {
  base::Stamp stamp;
  Se3 pose;
  double sigma_x, sigma_y, sigma_yaw;  // [m] [rad]
  bool located;
};

// A map of one half, and where its key frames are in the map of the whole log.
struct Half {
  std::vector<std::pair<Se3, Se3>> frames;  // in the whole, in the half
};

Half halfOf(const map::Map& half, const eval::Trajectory& whole) {
  Half result;
  for (const auto& frame : half.key_frames)
    if (frame.id.session == half.key_frames.front().id.session)
      if (const auto* pose = nearestInTime(whole, frame.stamp))
        result.frames.emplace_back(pose->world_from_body, geometry::fromMrpt(frame.map_from_base));
  return result;
}

// Where a pose of the whole map lies in the map of the half, and how far it is from that half's nearest key frame [m].
std::pair<Se3, double> inHalf(const Half& half, const Se3& in_whole) {
  const std::pair<Se3, Se3>* nearest = nullptr;
  double least = HUGE_VAL;
  for (const auto& frame : half.frames) {
    const double apart = (frame.first.translation - in_whole.translation).norm();
    if (apart >= least) continue;
    least = apart;
    nearest = &frame;
  }
  if (!nearest) return {in_whole, least};
  return {nearest->second * inverse(nearest->first) * in_whole, least};
}

std::vector<Estimate> estimatesIn(const std::string& folder) {
  constexpr double kDegree = M_PI / 180;
  std::vector<Estimate> all;
  std::ifstream file(folder + "/localization.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    double stamp, x, y, z, yaw, pitch, roll, sigma_x, sigma_y, sigma_yaw;
    int located = 0;
    if (!(row >> stamp >> x >> y >> z >> yaw >> pitch >> roll >> sigma_x >> sigma_y >> sigma_yaw >> located)) continue;
    const mrpt::poses::CPose3D pose(x, y, z, yaw * kDegree, pitch * kDegree, roll * kDegree);
    all.push_back(
        {base::stampFromUnix(stamp), geometry::fromMrpt(pose), sigma_x, sigma_y, sigma_yaw * kDegree, located == 1});
  }
  return all;
}

struct Row {
  std::size_t frames = 0, located = 0, mapped = 0, located_in_mapped = 0, wrong = 0;
  std::vector<double> errors;  // [m]
  double squares = 0;          // of errors over sigmas, x, y and yaw
};

Row compare(const std::string& folder, const Half& half, const eval::Trajectory& whole) {
  constexpr double kMapped = 3, kWrong = 0.5, kWrongTurn = 10 * M_PI / 180;  // [m] [m] [rad]
  Row row;
  for (const auto& estimate : estimatesIn(folder)) {
    ++row.frames;
    row.located += estimate.located;
    const auto* truth = nearestInTime(whole, estimate.stamp);
    if (!truth) continue;
    const auto [expected, apart] = inHalf(half, truth->world_from_body);
    row.mapped += apart <= kMapped;
    if (!estimate.located) continue;
    row.located_in_mapped += apart <= kMapped;
    const auto error = geometry::minus(estimate.pose, expected);
    const double metres = error.head<3>().norm(), turn = error.tail<3>().norm();
    row.wrong += metres > kWrong || turn > kWrongTurn;
    row.errors.push_back(metres);
    const Eigen::Vector3d off = estimate.pose.translation - expected.translation;
    row.squares += std::pow(off.x() / estimate.sigma_x, 2) + std::pow(off.y() / estimate.sigma_y, 2) +
                   std::pow(error[5] / estimate.sigma_yaw, 2);
  }
  std::sort(row.errors.begin(), row.errors.end());
  return row;
}

void print(const std::string& name, const Row& row, const std::string& verdict) {
  const auto percent = [](std::size_t part, std::size_t all) {
    return all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
  };
  const double median = row.errors.empty() ? NAN : row.errors[row.errors.size() / 2];
  const double worst = row.errors.empty() ? NAN : row.errors.back();
  std::printf("| %s | %zu | %.0f %% | %.0f %% | %zu | %.3f, %.3f | %.2f | %s |\n", name.c_str(), row.frames,
              percent(row.located, row.frames), percent(row.located_in_mapped, row.mapped), row.wrong, median, worst,
              std::sqrt(row.squares / (3 * static_cast<double>(std::max<std::size_t>(1, row.errors.size())))),
              verdict.c_str());
  std::fflush(stdout);
}

// Returns the verdict of a session that continues the map; else whether the log was located anywhere.
std::string localize(const Setup& setup, const std::string& log, const std::string& map, const std::string& folder,
                     const std::vector<std::string>& start) {
  mapper::RunRequest request;
  request.logs = {log};
  request.output_folder = folder;
  (setup.continues ? request.continue_map : request.localize_map) = map;
  try {
    const auto result = run(setup, request, start);
    return setup.continues ? toString(result.verdict.answer) : result.located > 0 ? "located" : "not located";
  } catch (const base::Error& error) {
    std::fprintf(stderr, "%s: %s\n", log.c_str(), error.what());
    return "not located";
  }
}

// A session that continues the map: the poses of all its key frames at the end, located if the session is aligned.
Row compareContinued(const std::string& folder, std::uint16_t session, const eval::Trajectory& whole) {
  constexpr double kWrong = 0.5;                                     // [m]
  if (!std::filesystem::exists(folder + "/map.omnimap")) return {};  // the run failed
  const auto both = log_parts::mapIn(folder);
  const auto half = halfOf(both, whole);
  Row row;
  for (const auto& frame : both.key_frames) {
    if (frame.id.session != session) continue;
    ++row.frames;
    const auto* truth = nearestInTime(whole, frame.stamp);
    if (!truth) continue;
    ++row.mapped;
    if (!both.sessions.back().aligned) continue;
    ++row.located;
    ++row.located_in_mapped;
    const auto expected = inHalf(half, truth->world_from_body).first;
    const double metres = (geometry::fromMrpt(frame.map_from_base).translation - expected.translation).norm();
    row.wrong += metres > kWrong;
    row.errors.push_back(metres);
  }
  std::sort(row.errors.begin(), row.errors.end());
  return row;
}

// Starts in the map that are at least 3 m away from where the log begins, with any heading.
std::vector<std::vector<std::string>> wrongStarts(const Half& half, const Se3& right, int count, unsigned seed) {
  constexpr double kApart = 3;  // [m]
  if (half.frames.empty()) return {};
  std::mt19937 generator(seed);
  std::uniform_int_distribution<std::size_t> frame(0, half.frames.size() - 1);
  std::uniform_real_distribution<double> heading(-180, 180);
  std::vector<std::vector<std::string>> starts;
  for (int tried = 0; static_cast<int>(starts.size()) < count && tried < 1000 * count; ++tried) {
    const auto& place = half.frames[frame(generator)].second.translation;
    if ((place - right.translation).norm() < kApart) continue;
    starts.push_back({"session.start=pose", "session.start_x_m=" + std::to_string(place.x()),
                      "session.start_y_m=" + std::to_string(place.y()),
                      "session.start_yaw_deg=" + std::to_string(heading(generator))});
  }
  return starts;
}

}  // namespace

int main(int argc, char** argv) {
  Setup setup;
  CLI::App app("Localizes halves of a log in the map of the other half, or a log in the map of another place.");
  app.add_option("-i,--ini", setup.ini)->required();
  app.add_option("-r,--rawlog", setup.log)->required();
  app.add_option("--in", setup.other, "a log of another place, in whose map nothing must be located");
  app.add_option("--wrong-starts", setup.wrong_starts, "number of wrong starts, in place of start = anywhere");
  app.add_flag("--continue", setup.continues, "the second part continues the map instead of being localized in it");
  app.add_option("--seed", setup.seed, "of the wrong starts");
  app.add_option("-o,--output", setup.out)->required();
  app.add_option("--set", setup.settings, "section.key=value");
  CLI11_PARSE(app, argc, argv);
  omnimapper::mapper::loadFeatures();
  std::filesystem::create_directories(setup.out);
  std::printf(
      "| log | key frames | located | of those within 3 m of the map | over 0.5 m or 10 deg off | error: median, worst "
      "[m] | over its sigma | verdict |\n|---|---|---|---|---|---|---|---|\n");
  const std::string name = std::filesystem::path(setup.log).stem().string();
  if (!setup.other.empty()) {
    makeMap(setup, setup.other, setup.out + "/other");
    const auto verdict = localize(setup, setup.log, setup.out + "/other/map.omnimap", setup.out + "/in_other",
                                  {"session.start=anywhere"});
    const auto row = compare(setup.out + "/in_other", {}, {});
    print(name + " in the map of " + std::filesystem::path(setup.other).stem().string(), row, verdict);
    return 0;
  }
  makeMap(setup, setup.log, setup.out + "/whole");
  const auto whole = log_parts::trajectoryOf(log_parts::mapIn(setup.out + "/whole"));
  const auto [begin, end] = log_parts::spanOf(setup.log);
  const auto middle = begin + (end - begin) / 2;
  const std::string parts[] = {setup.out + "/a", setup.out + "/b"};
  log_parts::write(setup.log, base::Stamp::min(), middle, parts[0] + ".rawlog");
  log_parts::write(setup.log, middle, base::Stamp::max(), parts[1] + ".rawlog");
  for (const bool forward : {true, false}) {
    const std::string &first = parts[forward ? 0 : 1], &second = parts[forward ? 1 : 0];
    makeMap(setup, first + ".rawlog", first);
    const auto half = halfOf(log_parts::mapIn(first), whole);
    const auto* right = nearestInTime(whole, log_parts::spanOf(second + ".rawlog").first);
    std::vector<std::vector<std::string>> starts{{"session.start=anywhere"}};
    if (setup.wrong_starts > 0)
      starts = wrongStarts(half, inHalf(half, (right ? *right : whole.front()).world_from_body).first,
                           setup.wrong_starts, setup.seed);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const std::string folder = second + "_" + std::to_string(i);
      std::filesystem::remove_all(folder);
      const auto verdict = localize(setup, second + ".rawlog", first + "/map.omnimap", folder, starts[i]);
      const std::string which = name + (forward ? ", second in first" : ", first in second") +
                                (setup.wrong_starts > 0 ? ", start " + std::to_string(i + 1) : "");
      print(which, setup.continues ? compareContinued(folder, 1, whole) : compare(folder, half, whole), verdict);
    }
  }
}
