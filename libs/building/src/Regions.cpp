#include "Regions.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace omnimapper::building {

namespace {

constexpr double kTooSmall = 100;  // by which the score of a border of a region that is too small is lower

double smallness(const Piece& region, const DoorWeights& weights) {
  // A room that has been seen in part is larger than its seen area.
  return std::exp(-region.area / weights.usual_area) * (1 - region.openness());
}

}  // namespace

Regions::Regions(const FreeSpace& space, const Pieces& pieces, const std::vector<Cut>& cuts,
                 const SegmentationOptions& options)
    : cuts_(cuts),
      options_(options),
      cell_(space.cell),
      step_(sampleStep(space)),
      pieces_(pieces.pieces),
      sets_(static_cast<int>(pieces.pieces.size())),
      borders_(cuts.size()) {
  for (std::size_t i = 0; i < cuts.size(); ++i) findBorders(i);
  for (auto border = weakest(); border && border->score <= 0; border = weakest()) join(*border);
}

std::optional<Border> Regions::weakest() const {
  const Border* lowest = nullptr;
  for (const auto& borders : borders_)
    for (const Border& border : borders)
      if (lowest == nullptr || border.score < lowest->score) lowest = &border;
  return lowest == nullptr ? std::nullopt : std::optional<Border>(*lowest);
}

void Regions::join(const Border& border) {
  const bool is_left_larger = pieces_[border.left].area >= pieces_[border.right].area;
  const int kept = is_left_larger ? border.left : border.right, other = is_left_larger ? border.right : border.left;
  sets_.join(kept, other);
  pieces_[kept].add(pieces_[other]);
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const auto concerns = [&](const Border& each) {
      return each.left == kept || each.right == kept || each.left == other || each.right == other;
    };
    if (std::any_of(borders_[i].begin(), borders_[i].end(), concerns)) findBorders(i);
  }
}

void Regions::findBorders(std::size_t cut) {
  constexpr double kNarrowest = 0.25, kLeastShare = 0.5;  // [m], and of the cut's width
  struct Stretch {
    int count = 0, first = 0, last = 0;  // samples of Cut::opening
  };
  std::map<std::pair<int, int>, Stretch> stretches;
  const auto& opening = cuts_[cut].opening;
  for (int i = 0; i < static_cast<int>(opening.size()); ++i) {
    if (opening[i].left == 0 || opening[i].right == 0) continue;
    const int left = sets_.find(opening[i].left), right = sets_.find(opening[i].right);
    if (left == right) continue;
    Stretch& stretch = stretches[{left, right}];
    if (stretch.count++ == 0) stretch.first = i;
    stretch.last = i;
  }
  borders_[cut].clear();
  const double width_of_cut = std::max(cell_, cuts_[cut].width() * cell_);
  for (const auto& [regions, stretch] : stretches) {
    const double width = std::min(width_of_cut, (stretch.count * step_ + 1) * cell_);
    if (width < kNarrowest && width < kLeastShare * width_of_cut) continue;
    Border border{regions.first, regions.second, width, stretch.first * step_, (stretch.last + 2) * step_, 0, {}};
    border.to = std::min(border.to, cuts_[cut].length());
    borders_[cut].push_back(judged(cuts_[cut], border));
  }
}

Border Regions::judged(const Cut& cut, Border border) {
  const DoorWeights& weights = options_.weights;
  const Piece &left = pieces_[border.left], &right = pieces_[border.right];
  const auto isBetween = [&](const Sides& sides) {
    return sides.left != 0 && sides.right != 0 && sets_.find(sides.left) == border.left &&
           sets_.find(sides.right) == border.right;
  };
  const double wall =
      static_cast<double>(std::count_if(cut.beyond.begin(), cut.beyond.end(), isBetween)) * step_ * cell_;
  const double close = std::max(cell_, std::min(cut.left_clearance, cut.right_clearance));
  const auto aligned = [&](double share) { return std::min(1.0, share / weights.aligned_saturation); };
  constexpr double kWidest = 1.2;  // more cannot be measured close to the cut
  border.evidence = {border.width / (2 * std::min(left.clearance, right.clearance)), wall / (wall + border.width),
                     cut.walls.less_aligned, cut.walls.crossing};
  border.score = weights.bias + weights.excess_width * std::max(0.0, border.width - weights.usual_width) +
                 weights.narrowing * border.evidence.narrowing +
                 weights.local_narrowing * std::min(kWidest, border.width / (2 * close)) +
                 weights.wall_coverage * border.evidence.wall_coverage +
                 weights.less_aligned * aligned(cut.walls.less_aligned) +
                 weights.more_aligned * aligned(cut.walls.more_aligned) + weights.crossing * cut.walls.crossing +
                 weights.most_crossing * cut.walls.most_crossing +
                 weights.small_area * std::max(smallness(left, weights), smallness(right, weights));
  if (std::min(left.area, right.area) < options_.least_area) border.score -= kTooSmall;
  return border;
}

}  // namespace omnimapper::building
