// The box of thesis 4.5.2.4 without relations between its landmarks, with those that are found, with all true ones, and
// with wrong ones among them; and whether the covariances can be believed. Prints Markdown; doc/results/relations.md
// shows it.
//
//   bench-relations --seeds 100
#include <CLI/CLI.hpp>
#include <cstdio>

#include "../plugins/RelationBox.h"
#include "omnimapper/graph/ChiSquare.h"

namespace {

using namespace omnimapper;
using plugins::RelationBox;

struct Row {
  const char* name;
  RelationBox::With with;
  double wrong_share;  // of the 27 true relations
  bool tested;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Relations between landmarks in the box of thesis 4.5.2.4.");
  unsigned seeds = 100;
  app.add_option("--seeds", seeds, "Runs of each row; default 100");
  CLI11_PARSE(app, argc, argv);

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
