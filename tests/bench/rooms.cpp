// How well rooms are found in plans with true rooms, of data/rooms or a similar folder.
//
//   bench-rooms ../shared/data/rooms -o out/rooms
//
// The folder ipa has plans as pictures, each empty, with furniture, with clutter and with both; the folder rose2 has
// laser maps, one of them while it grows. The last three plans and the last map of the tables are those on which
// nothing was chosen. --sweep halves and doubles each constant; --resolutions compares grids with other cells.

#include <omnimapper/building/Continuation.h>
#include <omnimapper/building/RoomsPicture.h>
#include <omnimapper/draw/Image.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>

#include "RoomPlans.h"
#include "RoomScores.h"

namespace fs = std::filesystem;
using namespace omnimapper;
using namespace omnimapper::bench;

namespace {

const std::vector<std::string> kPlans{"Freiburg52_scan", "lab_a_scan", "lab_c_scan", "lab_intel",  "lab_ipa",
                                      "office_a",        "office_e",   "NLB",        "lab_f_scan", "office_c"};
constexpr std::size_t kChosenOn = 7;  // the first plans
const std::vector<std::string> kVariants{"", "_furnitures", "_trashbins", "_furnitures_trashbins"};
const std::vector<std::string> kGrowing{"cartesium_3",  "cartesium_5",  "cartesium_7",  "cartesium_9",
                                        "cartesium_11", "cartesium_13", "cartesium_15", "cartesium_17"};

void writePicture(const fs::path& folder, const std::string& name, const grid::GridMap& grid,
                  const building::Segmentation& rooms) {
  if (folder.empty()) return;
  std::ofstream(folder / (name + ".png"), std::ios::binary) << draw::encodePng(building::drawRooms(grid, rooms));
}

struct IpaResult {
  PlanScore score;
  int cubicles = 0, true_cubicles = 0;
};

IpaResult scoreIpa(const IpaPlan& plan, const grid::GridMap& grid, CellNumbers segments) {
  const auto is_free = freeCells(grid);
  IpaResult result;
  std::vector<char> counts = is_free, in_cubicle(counts.size(), 0);
  for (std::size_t i = 0; i < counts.size(); ++i) in_cubicle[i] = plan.cubicles[i] != 0 && is_free[i] != 0 ? 1 : 0;
  const CellCounts all(plan.cubicles, segments, is_free);
  result.cubicles = roomsFound(all, 0.5);
  result.true_cubicles = static_cast<int>(all.rooms.size());
  std::map<int, double> inside;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (in_cubicle[i] != 0) ++inside[segments[i]];
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (in_cubicle[i] != 0) counts[i] = 0;
    const auto size = all.segments.find(segments[i]);
    if (size != all.segments.end() && 2 * inside[segments[i]] > size->second) segments[i] = 0;
  }
  result.score = scoreOfPlan({plan.truth, segments, counts});
  return result;
}

grid::GridMap gridOfIpa(const fs::path& folder, const std::string& name) {
  return gridOf(readGrey(folder / (name + ".png")), IpaPlan::kFree, IpaPlan::kFree);
}

/// Mean coefficients of the variants over some plans.
std::vector<double> tableOfIpa(const fs::path& folder, std::size_t from, std::size_t to, const fs::path& pictures,
                               const building::SegmentationOptions& options, bool prints) {
  std::vector<double> means(kVariants.size(), 0);
  for (std::size_t i = from; i < to; ++i) {
    const IpaPlan plan(folder, kPlans[i]);
    if (prints) std::printf("%-16s", plan.name.c_str());
    for (std::size_t variant = 0; variant < kVariants.size(); ++variant) {
      const auto grid = gridOfIpa(folder, plan.name + kVariants[variant]);
      const auto rooms = building::segmentRooms(grid, options);
      writePicture(pictures, plan.name + kVariants[variant], grid, rooms);
      const IpaResult result = scoreIpa(plan, grid, rooms.room_of_cell);
      means[variant] += result.score.mcc / static_cast<double>(to - from);
      if (!prints) continue;
      std::printf(" | %.3f p %.2f r %.2f +%d", result.score.mcc, result.score.precision, result.score.recall,
                  result.score.unmatched);
      if (result.true_cubicles > 0) std::printf(" (cubicles %d/%d)", result.cubicles, result.true_cubicles);
    }
    if (prints) std::printf("\n");
  }
  if (prints) std::printf("%-16s | %.3f | %.3f | %.3f | %.3f\n\n", "mean", means[0], means[1], means[2], means[3]);
  return means;
}

constexpr double kLeastCells = 400, kFoundFrom = 0.7;

std::pair<int, int> scoreRose(RosePlan plan, const CellNumbers& segments) {
  const auto is_free = freeCells(plan.grid);
  dropSmall(plan.truth, is_free, kLeastCells);
  const CellCounts counts(plan.truth, segments, is_free);
  return {roomsFound(counts, kFoundFrom), static_cast<int>(counts.rooms.size())};
}

/// The number of cells by which the second map is shifted against the first: where most obstacles coincide.
cv::Point shiftOf(const grid::GridMap& first, const grid::GridMap& second) {
  const auto obstacles = [](const grid::GridMap& grid, const cv::Size& size) {
    cv::Mat mask = cv::Mat::zeros(size, CV_32F);
    for (int y = 0; y < grid.rows; ++y)
      for (int x = 0; x < grid.columns; ++x)
        if (grid.at({x, y}) == grid::GridCell::occupied) mask.at<float>(y, x) = 1;
    return mask;
  };
  const cv::Size size(cv::getOptimalDFTSize(first.columns + second.columns),
                      cv::getOptimalDFTSize(first.rows + second.rows));
  cv::Mat a, b, product, correlation;
  cv::dft(obstacles(first, size), a);
  cv::dft(obstacles(second, size), b);
  cv::mulSpectrums(b, a, product, 0, true);
  cv::idft(product, correlation, cv::DFT_SCALE);
  cv::Point best;
  cv::minMaxLoc(correlation, nullptr, nullptr, nullptr, &best);
  if (best.x > second.columns) best.x -= size.width;
  if (best.y > second.rows) best.y -= size.height;
  return best;
}

/// For each true room of the second of two steps that was one in the first, whether its segment has another id.
std::pair<int, int> idChanges(const std::vector<RosePlan>& plans, const std::vector<CellNumbers>& segments,
                              const std::vector<cv::Point>& shifts, std::size_t step) {
  const auto segmentOf = [&](std::size_t i) {
    RosePlan plan = plans[i];
    const auto is_free = freeCells(plan.grid);
    dropSmall(plan.truth, is_free, kLeastCells);
    const CellCounts counts(plan.truth, segments[i], is_free);
    std::map<int, int> found;
    for (const auto& [ids, both] : counts.common)
      if (both >= kFoundFrom * (counts.rooms.at(ids.first) + counts.segments.at(ids.second) - both))
        found[ids.first] = ids.second;
    return found;
  };
  const auto before = segmentOf(step - 1), now = segmentOf(step);
  const RosePlan &old = plans[step - 1], &plan = plans[step];
  std::map<std::pair<int, int>, int> common;
  std::map<int, int> old_sizes, sizes;
  for (int y = 0; y < plan.grid.rows; ++y) {
    for (int x = 0; x < plan.grid.columns; ++x) {
      const Eigen::Vector2i there(x - shifts[step].x, y - shifts[step].y);
      const int room = plan.truth[plan.grid.indexOf({x, y})];
      const int earlier = old.grid.contains(there) ? old.truth[old.grid.indexOf(there)] : 0;
      ++sizes[room];
      ++old_sizes[earlier];
      if (room != 0 && earlier != 0) ++common[{earlier, room}];
    }
  }
  int changed = 0, unchanged = 0;
  for (const auto& [ids, both] : common) {
    const bool is_same = both > 0.7 * (old_sizes[ids.first] + sizes[ids.second] - both);
    if (!is_same || before.count(ids.first) == 0 || now.count(ids.second) == 0) continue;
    ++(before.at(ids.first) == now.at(ids.second) ? unchanged : changed);
  }
  return {changed, changed + unchanged};
}

void tableOfRose(const fs::path& folder, const std::vector<std::string>& whole, const fs::path& pictures) {
  std::vector<RosePlan> plans;
  std::vector<CellNumbers> segments;
  std::vector<cv::Point> shifts;
  building::Storey storey;
  int found = 0, all = 0, changed = 0, compared = 0;
  for (const std::string& name : kGrowing) {
    plans.emplace_back(folder, name);
    RosePlan& plan = plans.back();
    shifts.push_back(plans.size() < 2 ? cv::Point(0, 0) : shiftOf(plans[plans.size() - 2].grid, plan.grid));
    if (plans.size() > 1) {
      const geometry::Se2& before = plans[plans.size() - 2].grid.map_from_grid;
      plan.grid.map_from_grid = {before.x - shifts.back().x * 0.05, before.y - shifts.back().y * 0.05, 0};
    }
    auto rooms = building::segmentRooms(plan.grid);
    if (plans.size() > 1) rooms = building::continueRooms(storey, plan.grid, std::move(rooms)).now;
    storey = rooms.storey;
    segments.push_back(rooms.room_of_cell);
    writePicture(pictures, name, plan.grid, rooms);
    const auto [some, rooms_of_plan] = scoreRose(plan, segments.back());
    std::printf("%-20s %d of %d rooms, %zu found", name.c_str(), some, rooms_of_plan, storey.rooms.size());
    found += some;
    all += rooms_of_plan;
    if (plans.size() > 1) {
      const auto [changes, of] = idChanges(plans, segments, shifts, plans.size() - 1);
      std::printf(", %d of %d ids changed", changes, of);
      changed += changes;
      compared += of;
    }
    std::printf("\n");
  }
  std::printf("all steps: %d of %d rooms (%.1f %%); ids changed: %d of %d\n", found, all, 100.0 * found / all, changed,
              compared);
  for (const std::string& name : whole) {
    const RosePlan plan(folder, name);
    const auto rooms = building::segmentRooms(plan.grid);
    writePicture(pictures, name, plan.grid, rooms);
    const auto [some, of] = scoreRose(plan, rooms.room_of_cell);
    std::printf("%-20s %d of %d rooms, %zu found\n", name.c_str(), some, of, rooms.storey.rooms.size());
  }
}

void sweep(const fs::path& folder) {
  using Options = building::SegmentationOptions;
  const std::vector<std::pair<std::string, std::function<double&(Options&)>>> constants{
      {"least_area", [](Options& o) -> double& { return o.least_area; }},
      {"clutter", [](Options& o) -> double& { return o.clutter; }},
      {"roughness", [](Options& o) -> double& { return o.roughness; }},
      {"shortest_face", [](Options& o) -> double& { return o.shortest_face; }},
      {"shortest_wall", [](Options& o) -> double& { return o.shortest_wall; }},
      {"wall_offset", [](Options& o) -> double& { return o.wall_offset; }},
      {"longest_opening", [](Options& o) -> double& { return o.longest_opening; }},
      {"same_place", [](Options& o) -> double& { return o.same_place; }},
      {"bias", [](Options& o) -> double& { return o.weights.bias; }},
      {"excess_width", [](Options& o) -> double& { return o.weights.excess_width; }},
      {"usual_width", [](Options& o) -> double& { return o.weights.usual_width; }},
      {"narrowing", [](Options& o) -> double& { return o.weights.narrowing; }},
      {"local_narrowing", [](Options& o) -> double& { return o.weights.local_narrowing; }},
      {"wall_coverage", [](Options& o) -> double& { return o.weights.wall_coverage; }},
      {"less_aligned", [](Options& o) -> double& { return o.weights.less_aligned; }},
      {"more_aligned", [](Options& o) -> double& { return o.weights.more_aligned; }},
      {"crossing", [](Options& o) -> double& { return o.weights.crossing; }},
      {"most_crossing", [](Options& o) -> double& { return o.weights.most_crossing; }},
      {"small_area", [](Options& o) -> double& { return o.weights.small_area; }},
      {"usual_area", [](Options& o) -> double& { return o.weights.usual_area; }},
      {"aligned_saturation", [](Options& o) -> double& { return o.weights.aligned_saturation; }}};
  std::printf("%-20s | halved: empty, furniture and clutter | doubled\n", "constant");
  for (const auto& [name, of] : constants) {
    std::printf("%-20s", name.c_str());
    for (const double factor : {0.5, 2.0}) {
      Options options;
      of(options) *= factor;
      const auto means = tableOfIpa(folder, 0, kChosenOn, "", options, false);
      std::printf(" | %.3f %.3f", means.front(), means.back());
    }
    std::printf("\n");
  }
}

/// The plans with cells of half and of twice the side.
void compareResolutions(const fs::path& folder) {
  for (const double scale : {0.5, 2.0}) {
    double mean = 0;
    for (std::size_t i = 0; i < kChosenOn; ++i) {
      const IpaPlan plan(folder, kPlans[i]);
      const cv::Mat grey = readGrey(folder / (plan.name + ".png"));
      cv::Mat resized;
      if (scale < 1) {
        cv::resize(grey, resized, {}, 2, 2, cv::INTER_NEAREST);
      } else {
        cv::erode(grey, resized, cv::Mat::ones(2, 2, CV_8U));
        cv::resize(resized, resized, {(grey.cols + 1) / 2, (grey.rows + 1) / 2}, 0, 0, cv::INTER_NEAREST);
      }
      auto grid = gridOf(resized, IpaPlan::kFree, IpaPlan::kFree);
      grid.resolution *= scale;
      const auto rooms = building::segmentRooms(grid);
      const auto full = gridOf(grey, IpaPlan::kFree, IpaPlan::kFree);
      CellNumbers segments(full.cells.size());
      for (int y = 0; y < full.rows; ++y)
        for (int x = 0; x < full.columns; ++x)
          segments[full.indexOf({x, y})] =
              rooms.room_of_cell[grid.indexOf({std::min(grid.columns - 1, static_cast<int>(x / scale)),
                                               std::min(grid.rows - 1, static_cast<int>(y / scale))})];
      mean += scoreIpa(plan, full, segments).score.mcc / kChosenOn;
    }
    std::printf("cells of %.3f m: %.3f\n", 0.05 * scale, mean);
  }
}

/// Time for 100 m by 100 m at 0.05 m: a plan, repeated.
void measureTime(const fs::path& folder) {
  constexpr int kSide = 2000, kRuns = 5;
  const cv::Mat plan = readGrey(folder / "lab_intel_furnitures_trashbins.png");
  cv::Mat tiles;
  cv::repeat(plan, kSide / plan.rows + 1, kSide / plan.cols + 1, tiles);
  const auto grid = gridOf(tiles(cv::Rect(0, 0, kSide, kSide)).clone(), IpaPlan::kFree, IpaPlan::kFree);
  double least = 1e9;
  std::size_t rooms = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    rooms = building::segmentRooms(grid).storey.rooms.size();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::printf("100 m by 100 m, %zu rooms: %.2f s\n", rooms, least);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data, output;
  bool sweeps = false, resolutions = false, all = false;
  CLI::App app("How well rooms are found in plans with true rooms.");
  app.add_option("data", data, "folder with the folders ipa and rose2")->required();
  app.add_option("-o,--output", output, "folder for pictures");
  app.add_flag("--sweep", sweeps, "halve and double each constant");
  app.add_flag("--resolutions", resolutions, "also with other sides of cells");
  app.add_flag("--all", all, "also the plans and the map on which nothing was chosen");
  CLI11_PARSE(app, argc, argv);
  if (!output.empty()) fs::create_directories(output);
  const fs::path ipa = fs::path(data) / "ipa";
  std::printf("plan | mean MCC, precision, recall, unmatched segments: empty | furniture | clutter | both\n");
  tableOfIpa(ipa, 0, kChosenOn, output, {}, true);
  if (all) tableOfIpa(ipa, kChosenOn, kPlans.size(), output, {}, true);
  std::vector<std::string> whole{"freiburg_building52"};
  if (all) whole.emplace_back("g4s_y2");
  tableOfRose(fs::path(data) / "rose2", whole, output);
  measureTime(ipa);
  if (resolutions) compareResolutions(ipa);
  if (sweeps) sweep(ipa);
}
