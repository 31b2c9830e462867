// The box of thesis 4.5.2.4 without relations between its landmarks, with relations that are found, with all true ones,
// and with wrong ones among them; and whether the covariances are consistent with the errors. Prints Markdown and draws
// figures 42 to 44. doc/results/relations.md shows both.
//
//   bench-relations --seeds 100 --svg doc/results/relations.svg
#include <omnimapper/draw/Svg.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "../plugins/relations/RelationBox.h"
#include "omnimapper/graph/ChiSquare.h"

namespace {

using namespace omnimapper;
using plugins::RelationBox;

struct Row {
  const char* name;
  RelationBox::With with;
  double wrong_share;  // number of wrong relations, in parts of the 27 true ones
  bool tested;
};

void drawPanel(draw::Svg& svg, double left, const std::string& title, const RelationBox::Layout& layout,
               const RelationBox::Layout& truth) {
  constexpr double kSide = 310;
  const auto axes = draw::Axes::withEqualScale({left, 50}, {kSide, kSide}, {-3.5, -4}, {3.5, 4});
  axes.draw(svg, "x [m]", "y [m]");
  svg.text({left + kSide / 2, 22}, title, draw::Svg::Anchor::middle, 14);
  const auto drawWalls = [&](const std::vector<geometry::Segment2>& walls, const std::string& colour, double width) {
    for (const auto& wall : walls) svg.line(axes.pixel(wall.from), axes.pixel(wall.to), colour, width);
  };
  drawWalls(truth.walls, "#9a9a9a", 1);
  drawWalls(layout.walls, "#2471a3", 1.6);
  std::vector<Eigen::Vector2d> trajectory;
  for (const auto& pose : layout.poses) trajectory.push_back(axes.pixel(pose));
  svg.polyline(trajectory, "#c0392b", 0.8);
  for (const auto& at : trajectory) svg.dot(at, 1.8, "#c0392b");
  for (const auto& point : layout.points) svg.dot(axes.pixel(point), 2.6, "#1e8449");
}

// Draws figures 42, 43 and 44 of the thesis.
void drawMetrics(const std::string& path, unsigned seed) {
  const RelationBox box(seed);
  const auto without = RelationBox(seed).run(RelationBox::With::no_relations, 0, true),
             with = RelationBox(seed).run(RelationBox::With::found, 0, true);
  std::ofstream out(path);
  draw::Svg svg(out, 1100, 430);
  drawPanel(svg, 50, "initial belief", box.initialBelief(), box.truth());
  drawPanel(svg, 415, "optimized, without relations", without.found, box.truth());
  drawPanel(svg, 780, "optimized, with relations found", with.found, box.truth());
  svg.text({550, 418}, "poses red, points green, walls blue; true walls thin grey", draw::Svg::Anchor::middle);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Evaluates relations between landmarks in the box of thesis 4.5.2.4.");
  unsigned seeds = 100;
  app.add_option("--seeds", seeds, "Runs per row; default 100");
  std::string svg;
  app.add_option("--svg", svg, "File for a drawing of the first run: before optimization, without and with relations");
  CLI11_PARSE(app, argc, argv);
  if (!svg.empty()) drawMetrics(svg, 1);

  constexpr int kTrue = 27;
  const Row rows[] = {{"none", RelationBox::With::no_relations, 0, true},
                      {"found by likelihood", RelationBox::With::found, 0, true},
                      {"all true ones given", RelationBox::With::true_ones, 0, false},
                      {"found, and 10 % wrong ones", RelationBox::With::found, 0.1, true},
                      {"true, and 10 % wrong ones, tested", RelationBox::With::true_ones, 0.1, true},
                      {"true, and 10 % wrong ones, untested", RelationBox::With::true_ones, 0.1, false}};
  std::printf(
      "| relations | landmark error | pose error | proposed | refused | wrong ones acting | NEES of last pose (3) | "
      "NEES of a point (2) |\n|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    RelationBox::Error sum;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const auto one =
          RelationBox(seed).run(row.with, static_cast<int>(std::lround(row.wrong_share * kTrue)), row.tested);
      sum.pose += one.pose / seeds;
      sum.landmark += one.landmark / seeds;
      sum.pose_nees += one.pose_nees / seeds;
      sum.landmark_nees += one.landmark_nees / seeds;
      sum.relations += one.relations;
      sum.refused += one.refused;
      sum.wrong += one.wrong;
    }
    const double n = seeds;
    std::printf("| %s | %.4f m | %.4f m | %.1f | %.1f | %.2f | %.2f | %.2f |\n", row.name, sum.landmark, sum.pose,
                sum.relations / n, sum.refused / n, sum.wrong / n, sum.pose_nees, sum.landmark_nees);
  }
  const auto bounds = [&](int size) {
    const int all = size * static_cast<int>(seeds);
    std::printf("95 %% bounds of a mean NEES of %d over %u seeds: %.2f to %.2f\n", size, seeds,
                graph::chiSquareQuantile(0.025, all) / seeds, graph::chiSquareQuantile(0.975, all) / seeds);
  };
  bounds(3);
  bounds(2);
}
