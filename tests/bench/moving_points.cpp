// How well laser odometry tells the points of people from those of what stands. The truth is that of the simulator: the
// beams of each scan that ended on a person (truth/laser_bodies.csv). A point counts as moving if its person walks, or
// has walked within the last two seconds; people who stand count as neither. Mixed and mirrored beams are left out.
// Prints recall and precision by beams, and the share of all other beams that were called moving.
//
// --labelled is a folder of real scans in which legs were labelled (CSV: angle [rad], range [m] or 0, leg 1 or 0; the
// name of a file is its time, 20200826-12_55_45.669667.csv). Whether a leg moved is not known.
//
// Example: bench-moving_points out/company/logs/*/*
// Example: bench-moving_points --labelled ../shared/data/people/legs_labelled_scans
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/obs/registerClasses.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "UntunedLogs.h"
#include "laser2d/ScanOdometryPlugin.h"

namespace {

using namespace omnimapper;

enum class Beam { other, walking, standing, unclear };

// For the scans that show people, by stamp in microseconds, what each beam ended on.
using Truth = std::map<long long, std::map<std::size_t, Beam>>;

long long microseconds(double unix_time) {
  return std::llround(unix_time * 1e6);
}

Truth readTruth(const std::string& path) {
  constexpr double kWalks = 0.1, kLately = 2;  // [m/s] [s]
  Truth truth;
  std::map<std::string, double> walked;  // when each person walked last
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::stringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (cells.size() < 8) continue;
    const double stamp = std::stod(cells[0]);
    if (std::stod(cells[4]) > kWalks) walked[cells[2]] = stamp;
    const bool walks = walked.count(cells[2]) > 0 && stamp - walked[cells[2]] < kLately;
    const Beam beam = cells[7] != "clear" ? Beam::unclear : walks ? Beam::walking : Beam::standing;
    const auto first = std::stoul(cells[5]), count = std::stoul(cells[6]);
    for (std::size_t i = first; i < first + count; ++i) truth[microseconds(stamp)][i] = beam;
  }
  return truth;
}

struct Counts {
  std::size_t walking = 0, found = 0, others = 0, mistaken = 0;
  void add(const Counts& more) {
    walking += more.walking;
    found += more.found;
    others += more.others;
    mistaken += more.mistaken;
  }
};

Counts compared(const mrpt::obs::CObservation2DRangeScan& raw, const mrpt::obs::CObservation2DRangeScan& usable,
                const Truth& truth) {
  Counts counts;
  const auto people = truth.find(microseconds(mrpt::Clock::toDouble(raw.timestamp)));
  for (std::size_t i = 0; i < raw.getScanSize(); ++i) {
    if (!raw.getScanRangeValidity(i) || raw.getScanRange(i) >= raw.maxRange) continue;
    Beam beam = Beam::other;
    if (people != truth.end()) {
      const auto found = people->second.find(i);
      if (found != people->second.end()) beam = found->second;
    }
    const bool moves = !usable.getScanRangeValidity(i);
    counts.walking += beam == Beam::walking;
    counts.found += beam == Beam::walking && moves;
    counts.others += beam == Beam::other;
    counts.mistaken += beam == Beam::other && moves;
  }
  return counts;
}

Counts countsOf(const untuned::Log& log, const std::string& bodies) {
  using mrpt::obs::CObservation2DRangeScan;
  const auto truth = readTruth(bodies);
  plugins::ScanOdometryPlugin odometry({}, {}, {}, {});
  const auto observations = untuned::read(log);
  for (const auto& observation : observations) odometry.add(observation);
  Counts counts;
  for (const auto& observation : observations) {
    const auto scan = std::dynamic_pointer_cast<const CObservation2DRangeScan>(observation);
    if (!scan) continue;
    odometry.processUntil(scan->timestamp);
    const auto usable = std::dynamic_pointer_cast<const CObservation2DRangeScan>(odometry.usablePart(scan));
    if (usable) counts.add(compared(*scan, *usable, truth));
  }
  return counts;
}

// Seconds by the date and time in the name of a file, as if all months had 31 days.
double secondsInName(const std::string& name) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0;
  std::sscanf(name.c_str(), "%4d%2d%2d-%2d_%2d_%lf", &year, &month, &day, &hour, &minute, &second);
  return ((31. * month + day) * 24 + hour) * 3600 + 60. * minute + second;
}

// Legs count as people who walk.
Counts countsOfLabelled(const std::string& folder) {
  using mrpt::obs::CObservation2DRangeScan;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  plugins::ScanOdometryPlugin odometry({}, {}, {}, {});
  Counts counts;
  for (const auto& file : files) {
    std::vector<float> ranges;
    std::vector<bool> legs;
    std::ifstream in(file);
    float angle = 0, range = 0, leg = 0;
    for (char comma = 0; in >> angle >> comma >> range >> comma >> leg;) {
      ranges.push_back(range);
      legs.push_back(leg > 0.5F);
    }
    auto scan = CObservation2DRangeScan::Create();
    scan->sensorLabel = "laser";
    scan->timestamp = base::stampFromUnix(1e9 + secondsInName(file.stem().string()));
    scan->aperture = static_cast<float>(2 * M_PI * (1 - 1. / static_cast<double>(ranges.size())));
    scan->maxRange = 30;
    scan->resizeScan(ranges.size());
    Truth truth;
    auto& beams = truth[microseconds(mrpt::Clock::toDouble(scan->timestamp))];
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      scan->setScanRange(i, ranges[i]);
      scan->setScanRangeValidity(i, ranges[i] > 0);
      if (legs[i]) beams[i] = Beam::walking;
    }
    odometry.add(scan);
    odometry.processUntil(scan->timestamp);
    const auto usable = std::dynamic_pointer_cast<const CObservation2DRangeScan>(odometry.usablePart(scan));
    if (usable) counts.add(compared(*scan, *usable, truth));
  }
  return counts;
}

void print(const std::string& name, const Counts& counts) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : NAN;
  };
  std::printf("| %s | %zu | %.1f | %.1f | %.3f |\n", name.c_str(), counts.walking, share(counts.found, counts.walking),
              share(counts.found, counts.found + counts.mistaken), share(counts.mistaken, counts.others));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> folders;
  std::string labelled;
  CLI::App app("Compares the points that laser odometry calls moving with the simulator's truth.");
  app.add_option("folders", folders, "folders of simulated logs");
  app.add_option("--labelled", labelled, "folder of scans in which legs are labelled")->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  obs::registerClasses();
  std::printf(
      "| log | beams on people who walk | recall [%%] | precision [%%] | other beams called moving [%%] |\n"
      "|---|---|---|---|---|\n");
  if (!labelled.empty()) print("legs in real scans", countsOfLabelled(labelled));
  Counts all;
  for (const std::string& folder : folders) {
    std::string rawlog;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".rawlog") rawlog = entry.path().string();
    }
    const std::string bodies = folder + "/truth/laser_bodies.csv";
    if (rawlog.empty() || !std::filesystem::exists(bodies)) continue;
    const auto counts = countsOf({folder, rawlog, folder + "/truth.tum"}, bodies);
    print(folder, counts);
    all.add(counts);
  }
  if (!folders.empty()) print("all", all);
  return 0;
}
