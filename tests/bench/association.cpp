// How many lines of a laser are matched with the wrong landmark, by nearest neighbour and by joint compatibility. A
// simulated log, whose truth has the surface that each beam hit, is mapped with both. A landmark stands for the surface
// that most of its lines lie on; a line on a surface of another plane is a wrong match. Prints a Markdown table.
//
// Example: bench-association -i ini/home_planes.ini --simulated out/home -o out/association
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/obs/CObservationLaserLines.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "SimulatedRun.h"

namespace {

using namespace omnimapper;

struct Setup {
  std::string ini, section = "plane_landmarks", out;
  bench::SimulatedPlace place;
  std::vector<std::string> settings;
  int threads = 1;
  bool list = false;
};

struct Outcome {
  std::size_t key_frames = 0, landmarks = 0, matches = 0, wrong = 0;
  double ate = 0, milliseconds = 0;  // [m], and [ms] of the plugin per key frame
};

/// The simulator's truth for the laser: the surface that each beam of a scan hit, and the planes of the surfaces.
class Truth {
 public:
  explicit Truth(const std::string& folder) {
    std::ifstream world(folder + "/landmarks.json");
    const auto landmarks = nlohmann::json::parse(world);
    for (const auto& surface : landmarks["surfaces"]) {
      if (!surface.contains("normal")) continue;  // a curved one
      const auto& n = surface["normal"];
      planes_[surface["label"].get<int>()] = {{n[0].get<double>(), n[1].get<double>(), n[2].get<double>()},
                                              surface["distance"].get<double>()};
    }
    std::ifstream scans(folder + "/truth/laser.jsonl");
    for (std::string line; std::getline(scans, line);) {
      const auto scan = nlohmann::json::parse(line);
      std::vector<int> beams;
      for (const auto& run : scan["truth"]["surfaces"]) beams.insert(beams.end(), run[1].get<int>(), run[0].get<int>());
      scans_[key(scan["stamp"].get<double>())] = std::move(beams);
    }
  }
  /// The surface that most beams of a line hit; 0 if fewer than four of five lie on its plane, since a line over two
  /// surfaces, such as a door and its edge, belongs to neither.
  int surfaceOf(base::Stamp stamp, const obs::LaserLine& line) const {
    const auto& beams = scans_.at(key(base::unixSeconds(stamp)));
    std::map<int, int> counts;
    for (std::size_t i = line.first_beam; i <= line.last_beam && i < beams.size(); ++i) ++counts[beams[i]];
    const int surface = most(counts);
    int all = 0, on_plane = 0;
    for (const auto& [other, count] : counts) {
      all += count;
      on_plane += isFlat(surface) && isFlat(other) && areOnePlane(surface, other) ? count : 0;
    }
    return 5 * on_plane >= 4 * all ? surface : 0;
  }
  bool isFlat(int surface) const { return planes_.count(surface) > 0; }
  bool areOnePlane(int a, int b) const {
    if (a == b) return true;
    const auto &p = planes_.at(a), &q = planes_.at(b);
    return p.normal.dot(q.normal) > std::cos(0.05) && std::abs(p.distance - q.distance) < 0.05;
  }
  static int most(const std::map<int, int>& counts) {
    return std::max_element(counts.begin(), counts.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

 private:
  // Stamps are compared in steps of 0.1 ms, because a double of Unix time is only accurate to a microsecond.
  static std::int64_t key(double unix_seconds) { return std::llround(unix_seconds * 1e4); }

  std::map<int, geometry::Plane3> planes_;
  std::map<std::int64_t, std::vector<int>> scans_;
};

// The middle of a line in the base, read from its factor, which holds its direction and middle.
Eigen::Vector3d middleOf(const graph::Factor& factor) {
  std::stringstream bytes;
  factor.write(bytes);
  Eigen::Matrix<double, 6, 1> numbers;
  for (double& number : numbers) number = graph::readDouble(bytes);
  return numbers.tail<3>();
}

const obs::LaserLine* lineOf(const map::KeyFrame& frame, const Eigen::Vector3d& middle) {
  for (const auto& observation : frame.observations) {
    const auto* lines = dynamic_cast<const obs::CObservationLaserLines*>(observation.get());
    if (!lines) continue;
    for (const auto& line : lines->lines) {
      const Eigen::Vector2d in_sensor = geometry::middle(line.segment_in_sensor);
      const Eigen::Vector3d in_base =
          geometry::fromMrpt(lines->sensorPose) * Eigen::Vector3d(in_sensor.x(), in_sensor.y(), 0);
      if ((in_base - middle).norm() < 1e-9) return &line;
    }
  }
  return nullptr;
}

Outcome judge(const Setup& setup, const derived::SavedMap& saved, const Truth& truth) {
  std::map<base::VariableId, const map::KeyFrame*> frames;
  for (const auto& frame : saved.map.key_frames) frames[frame.pose] = &frame;
  std::map<base::LandmarkId, std::map<int, int>> surfaces;  // number of lines on each surface, by landmark
  for (const auto& [id, record] : saved.graph.factors()) {
    if (record.tags.owner != setup.section || record.factor->kind() != "line_on_plane") continue;
    const map::KeyFrame& frame = *frames.at(record.variables[0]);
    const auto* line = lineOf(frame, middleOf(*record.factor));
    const int surface = line ? truth.surfaceOf(frame.stamp, *line) : 0;
    if (truth.isFlat(surface)) ++surfaces[*record.tags.landmark][surface];
  }
  Outcome outcome;
  outcome.key_frames = saved.map.key_frames.size();
  outcome.landmarks = surfaces.size();
  for (const auto& [id, counts] : surfaces) {
    const int own = Truth::most(counts);
    for (const auto& [surface, count] : counts) {
      outcome.matches += static_cast<std::size_t>(count);
      if (truth.areOnePlane(own, surface)) continue;
      outcome.wrong += static_cast<std::size_t>(count);
      if (setup.list)
        std::printf("landmark %u: %d lines of surface %d, but %d of its own surface %d\n", id.index, count, surface,
                    counts.at(own), own);
    }
  }
  return outcome;
}

Outcome run(const Setup& setup, const std::string& method, const Truth& truth) {
  auto settings = setup.settings;
  settings.push_back(setup.section + ".association=" + method);
  const auto mapped = bench::mapSimulated(setup.place, setup.ini, settings, setup.out + "/" + method, setup.threads);
  Outcome outcome = judge(setup, mapped.saved, truth);
  outcome.ate = mapped.error.rmse;
  outcome.milliseconds = 1e3 * mapped.summary["stage_times"]["plugin " + setup.section]["seconds"].get<double>() /
                         static_cast<double>(outcome.key_frames);
  return outcome;
}

}  // namespace

int main(int argc, char** argv) {
  Setup setup;
  CLI::App app("Counts wrong matches of nearest neighbour and joint compatibility, by the truth of a simulated log.");
  app.add_option("-i,--ini", setup.ini)->required();
  app.add_option("--simulated", setup.place.folder, "folder that omnimapper-simulate wrote")->required();
  app.add_option("-o,--output", setup.out)->required();
  app.add_option("--section", setup.section, "section of the plugin; default plane_landmarks");
  app.add_option("--threads", setup.threads);
  app.add_flag("--list", setup.list, "before the table, list each landmark that has lines of two surfaces");
  app.add_option("--set", setup.settings, "section.key=value");
  CLI11_PARSE(app, argc, argv);
  omnimapper::mapper::loadFeatures();
  const Truth truth(setup.place.folder);
  std::printf(
      "| association | key frames | landmarks | matches | wrong per 1,000 | ATE | per key frame |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const std::string method : {"nearest", "joint"}) {
    const Outcome outcome = run(setup, method, truth);
    std::printf("| %s | %zu | %zu | %zu | %.1f | %.3f m | %.2f ms |\n", method.c_str(), outcome.key_frames,
                outcome.landmarks, outcome.matches,
                1e3 * static_cast<double>(outcome.wrong) / static_cast<double>(outcome.matches), outcome.ate,
                outcome.milliseconds);
    std::fflush(stdout);
  }
}
