// How often the kind of a room is right by what is in it, on simulated plans.
//
//   bench-room_kinds --plans 30
//
// The true rooms and surfaces of homes, offices and laboratories, of which some surfaces are not seen and others are
// taken for something else. Each fifth plan is predicted by a model that was learned on the other four. --write FILE
// writes the model of all plans as libs/building/src/learnedKinds.cpp.

#include <omnimapper/building/RoomKinds.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace omnimapper;
using building::KindModel;

namespace {

constexpr double kUnseen = 0.4, kWrong = 0.15;

struct Example {
  std::string kind;
  std::vector<std::size_t> bins;
  int fold = 0;
};

// Names of the simulator for one kind, as people call it.
std::string kindOf(const sim::Room& room) {
  if (room.kind == "hallway" || room.kind == "hall") return "corridor";
  std::string kind = room.kind;
  std::replace(kind.begin(), kind.end(), '_', ' ');
  return kind;
}

/// The room as a map would have it: its area, and the largest distance of a point from its outline.
building::Room measured(const sim::Room& room) {
  building::Room result;
  result.outline = room.outline;
  result.area = std::abs(geometry::area(room.outline));
  Eigen::Vector2d low = room.outline.front(), high = low;
  for (const auto& corner : room.outline) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  constexpr double kStep = 0.1;
  for (double x = low.x(); x <= high.x(); x += kStep) {
    for (double y = low.y(); y <= high.y(); y += kStep) {
      const Eigen::Vector2d point(x, y);
      if (!building::contains(result, point)) continue;
      double least = 1e9;
      for (std::size_t i = 0, j = room.outline.size() - 1; i < room.outline.size(); j = i++)
        least = std::min(least, geometry::distance({room.outline[j], room.outline[i]}, point));
      result.clearance = std::max(result.clearance, least);
    }
  }
  return result;
}

// Surfaces that are not flat, such as a bathtub, count once, too.
Eigen::Vector3d middleOf(const sim::Body& body, int surface) {
  Eigen::Vector3d sum(0, 0, 0);
  double count = 0;
  for (const auto& triangle : body.triangles) {
    if (triangle.surface != surface) continue;
    for (const int corner : triangle.corners) sum += body.vertices_in_body[static_cast<std::size_t>(corner)];
    count += 3;
  }
  return count > 0 ? Eigen::Vector3d(sum / count) : sum;
}

std::map<std::string, building::RoomContents> contentsOf(const sim::World& world, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::map<std::string, building::RoomContents> contents;
  for (const auto& body : world.bodies) {
    const auto map_from_body = body.track.at(0);
    if (!map_from_body) continue;
    for (std::size_t i = 0; i < body.surfaces.size(); ++i) {
      const sim::Surface& surface = body.surfaces[i];
      const Eigen::Vector3d middle = *map_from_body * middleOf(body, static_cast<int>(i));
      std::string name = toString(surface.is);
      const auto& features = building::kindFeatures();
      constexpr std::size_t kClasses = 7;
      const bool counts = std::any_of(features.begin(), features.begin() + kClasses,
                                      [&](const auto& feature) { return feature.name == name; });
      if (!counts || share(random) < kUnseen) continue;
      if (share(random) < kWrong)
        name = features[std::uniform_int_distribution<std::size_t>(0, kClasses - 1)(random)].name;
      for (const auto& room : world.rooms) {
        building::Room outline;
        outline.outline = room.outline;
        if (building::contains(outline, middle.head<2>())) ++contents[room.name][name];
      }
    }
  }
  return contents;
}

std::vector<Example> examplesOf(int plans, int first) {
  std::vector<Example> examples;
  for (const char* generator : {"home", "office", "laboratory"}) {
    for (int plan = first; plan < first + plans; ++plan) {
      sim::WorldOptions options;
      options.generator = generator;
      options.seed = options.plan_seed = plan;
      const auto world = sim::makeWorld(sim::generate(options, "room_kinds"));
      std::mt19937 random(static_cast<unsigned>(plan));
      auto contents = contentsOf(world, random);
      for (const auto& room : world.rooms) {
        if (room.is_outdoors) continue;
        const auto doors = static_cast<std::size_t>(
            std::count_if(world.openings.begin(), world.openings.end(), [&](const surfaces::Opening& opening) {
              return opening.kind != surfaces::Opening::Kind::window &&
                     opening.leaf != surfaces::Opening::Leaf::closed &&
                     (opening.rooms[0] == room.name || opening.rooms[1] == room.name);
            }));
        examples.push_back({kindOf(room), building::kindBins(measured(room), doors, contents[room.name]), plan % 5});
      }
    }
  }
  return examples;
}

/// Learns from the examples of all folds but one; -1: from all.
KindModel learned(const std::vector<Example>& examples, int left_out) {
  std::map<std::string, std::vector<const Example*>> by_kind;
  for (const auto& example : examples)
    if (example.fold != left_out) by_kind[example.kind].push_back(&example);
  KindModel model;
  for (const auto& [kind, of_kind] : by_kind) {
    auto& table = model.log_likelihood.emplace_back();
    model.kinds.push_back(kind);
    for (std::size_t i = 0; i < building::kindFeatures().size(); ++i) {
      const std::size_t bins = building::kindFeatures()[i].bins;
      std::vector<double> counts(bins, 1);
      for (const auto* example : of_kind) ++counts[example->bins[i]];
      const double sum = static_cast<double>(of_kind.size() + bins);
      auto& row = table.emplace_back();
      for (const double count : counts) row.push_back(std::round(100 * std::log(count / sum)) / 100);
    }
  }
  return model;
}

struct Score {
  int all = 0, right = 0, sure = 0, sure_right = 0;
  void add(bool is_right, double confidence) {
    ++all;
    right += is_right ? 1 : 0;
    if (confidence < building::kSureKind) return;
    ++sure;
    sure_right += is_right ? 1 : 0;
  }
};

void print(const std::string& name, const Score& score) {
  std::printf("| %-12s | %d | %.1f %% | %d | %.1f %% |\n", name.c_str(), score.all, 100.0 * score.right / score.all,
              score.sure, score.sure > 0 ? 100.0 * score.sure_right / score.sure : 0);
}

void crossValidate(const std::vector<Example>& examples, bool sees_things, double tempering) {
  std::map<std::string, Score> scores;
  Score all;
  for (int fold = 0; fold < 5; ++fold) {
    KindModel model = learned(examples, fold);
    model.tempering = tempering;
    for (const auto& example : examples) {
      if (example.fold != fold) continue;
      const auto kinds = building::likelyKinds(model, example.bins, sees_things);
      scores[example.kind].add(kinds.front().first == example.kind, kinds.front().second);
      all.add(kinds.front().first == example.kind, kinds.front().second);
    }
  }
  std::printf("\n%s, tempering %.2f\n| kind | rooms | right | sure | right of them |\n|---|---|---|---|---|\n",
              sees_things ? "contents and shape" : "shape alone", tempering);
  for (const auto& [kind, score] : scores) print(kind, score);
  print("all", all);
}

void writeModel(const KindModel& model, const std::string& path) {
  std::ofstream out(path);
  out << "// Written by bench-room_kinds --write.\n#include <omnimapper/building/RoomKinds.h>\n\nnamespace "
         "omnimapper::building {\n\nconst KindModel& learnedKinds() {\n  static const KindModel model{{";
  for (const auto& kind : model.kinds) out << (kind == model.kinds.front() ? "" : ", ") << '"' << kind << '"';
  out << "},\n{";
  for (const auto& table : model.log_likelihood) {
    out << "{";
    for (const auto& row : table) {
      out << "{";
      for (std::size_t i = 0; i < row.size(); ++i) out << (i > 0 ? ", " : "") << row[i];
      out << "}, ";
    }
    out << "},\n";
  }
  out << "}};\n  return model;\n}\n\n}  // namespace omnimapper::building\n";
}

}  // namespace

int main(int argc, char** argv) {
  int plans = 30;
  std::string path;
  CLI::App app("How often the kind of a room is right by what is in it", "bench-room_kinds");
  app.add_option("--plans", plans, "plans of each generator");
  app.add_option("--write", path, "file for the model of all plans");
  CLI11_PARSE(app, argc, argv);
  const auto examples = examplesOf(plans, 1);
  const double usual = KindModel().tempering;
  for (const double tempering : {usual, usual / 2, 2 * usual})
    for (const bool sees_things : {true, false}) crossValidate(examples, sees_things, tempering);
  if (!path.empty()) writeModel(learned(examples, -1), path);
}
