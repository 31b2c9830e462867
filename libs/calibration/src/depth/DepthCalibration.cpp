#include "DepthCalibration.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace omnimapper::calibration {

namespace {

using camera::DepthDistortion;

constexpr std::size_t kFewestImages = 12, kFewestPatches = 8, kFewestOfPart = 3;
constexpr double kLooseBound = 0.010,
                 kTightBound = 0.006;  // [1/m] of growPatches() without and with a known distortion

[[noreturn]] void refuseCalibration(const std::string& why) {
  throw base::Error(base::ExitCode::nothing_to_map, why + "; nothing was written");
}

bool isImageHeldBack(std::size_t image) {
  return image % 3 == 1;
}

std::vector<FlatPatch> patchesOf(const std::vector<DepthCells>& images, bool held_back, const DepthDistortion& known) {
  std::vector<FlatPatch> all;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (isImageHeldBack(i) != held_back) continue;
    for (auto& patch : growPatches(images[i], known, known.isNone() ? kLooseBound : kTightBound)) {
      patch.image = i;
      all.push_back(std::move(patch));
    }
  }
  return all;
}

// Refuses if too few parts of the image show a plane in enough images.
void refuseWhatIsNotCovered(const std::vector<FlatPatch>& patches) {
  constexpr int kColumns = 8, kRows = 6;
  constexpr double kLeastShare = 0.6;
  std::map<int, std::set<std::size_t>> images_of_part;
  for (const auto& patch : patches) {
    for (const auto& s : patch.samples) {
      const int column = std::clamp(static_cast<int>((s.x + 1) / 2 * kColumns), 0, kColumns - 1);
      const int row = std::clamp(static_cast<int>((s.y + 1) / 2 * kRows), 0, kRows - 1);
      images_of_part[row * kColumns + column].insert(patch.image);
    }
  }
  const auto covered = std::count_if(images_of_part.begin(), images_of_part.end(),
                                     [](const auto& part) { return part.second.size() >= kFewestOfPart; });
  const double share = static_cast<double>(covered) / (kColumns * kRows);
  if (share >= kLeastShare) return;
  refuseCalibration("planes cover only " + base::fixed(100 * share, 0) +
                    " % of the image in three images or more, of " + base::fixed(100 * kLeastShare, 0) +
                    " % that are needed; come so near to walls, floors or tables that they fill the image");
}

double rmsOfAllButWorst(std::vector<double> misses) {
  constexpr double kWorst = 0.1;
  for (double& miss : misses) miss = std::abs(miss);
  std::sort(misses.begin(), misses.end());
  const auto count = misses.size() - static_cast<std::size_t>(kWorst * static_cast<double>(misses.size()));
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) squares += misses[i] * misses[i];
  return count == 0 ? 0 : std::sqrt(squares / static_cast<double>(count));
}

HeldFlatness flatnessOf(const std::vector<FlatPatch>& patches, const DepthDistortion& distortion, double scale) {
  HeldFlatness flatness;
  std::vector<double> all;
  std::map<std::size_t, std::vector<double>> by_image;
  for (const auto& patch : patches) {
    const auto misses = missesOf(patch, distortion, 2 * scale);
    for (std::size_t i = 0; i < misses.size(); ++i)
      flatness.misses.push_back({patch.samples[i].x, patch.samples[i].y, misses[i]});
    all.insert(all.end(), misses.begin(), misses.end());
    auto& of_image = by_image[patch.image];
    of_image.insert(of_image.end(), misses.begin(), misses.end());
  }
  flatness.rms = rmsOfAllButWorst(all);
  for (const auto& [image, misses] : by_image) flatness.rms_of_image.push_back(rmsOfAllButWorst(misses));
  return flatness;
}

// Root mean square of the difference over the image [1/m].
double rmsBetween(const DepthDistortion& a, const DepthDistortion& b) {
  constexpr int kSide = 20;
  double squares = 0;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = (2.0 * column + 1) / kSide - 1, y = (2.0 * row + 1) / kSide - 1;
      squares += std::pow(a.at(x, y) - b.at(x, y), 2);
    }
  }
  return std::sqrt(squares) / kSide;
}

double differenceOfHalves(const std::vector<FlatPatch>& patches, std::size_t images, int degree,
                          const std::function<bool()>& stop) {
  std::vector<FlatPatch> first, second;
  for (const auto& patch : patches) (2 * patch.image < images ? first : second).push_back(patch);
  return rmsBetween(fitDistortion(first, degree, stop).distortion, fitDistortion(second, degree, stop).distortion);
}

void setDepths(const std::vector<FlatPatch>& patches, DepthCalibration& result) {
  std::vector<double> inverse;
  for (const auto& patch : patches)
    for (const auto& s : patch.samples) inverse.push_back(s.inverse_depth);
  std::sort(inverse.begin(), inverse.end());
  const auto rest = inverse.size() / 20;
  result.nearest = 1 / inverse[inverse.size() - 1 - rest];
  result.farthest = 1 / inverse[rest];
}

void refuseWhatIsNoBetter(const DepthCalibration& found) {
  constexpr double kLeastGain = 0.03, kLeastImages = 2.0 / 3;
  const double gain = 1 - found.after.rms / found.before.rms;
  const auto images = found.before.rms_of_image.size();
  if (gain >= kLeastGain && static_cast<double>(found.flatter_images) >= kLeastImages * static_cast<double>(images))
    return;
  refuseCalibration(
      "planes of held-back images get no flatter: " + base::fixed(1000 * found.before.rms, 2) + " before and " +
      base::fixed(1000 * found.after.rms, 2) + " after, in 1/1000 of 1/m, and flatter in " +
      std::to_string(found.flatter_images) + " of " + base::counted(images, "image") +
      "; either the depths need no correction, or the log shows too few large planes: record walls, floors or "
      "tables in every part of the image, from near and far");
}

}  // namespace

DepthCalibration calibrateDepth(const std::vector<DepthCells>& images, int degree, base::Progress& progress,
                                const std::function<bool()>& stop) {
  DepthCalibration result;
  result.images = images.size();
  if (images.size() < kFewestImages)
    refuseCalibration("the log shows " + base::counted(images.size(), "different depth image") + " of " +
                      std::to_string(kFewestImages) +
                      " that are needed; record half a minute in which the camera turns and moves in front of walls, "
                      "floors or tables");
  result.cell_pixels = images.front().width / images.front().columns;
  const auto held = patchesOf(images, true, {});
  result.held_images = (images.size() + 1) / 3;
  result.held_patches = held.size();
  auto patches = patchesOf(images, false, {});
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    if (patches.size() < kFewestPatches || held.empty())
      refuseCalibration("the depth images show only " + base::counted(patches.size() + held.size(), "large plane") +
                        ", too few; come so near to walls, floors or tables that they fill "
                        "the image");
    refuseWhatIsNotCovered(patches);
    progress.report(0.85 + 0.05 * round, "fitting planes");
    result.fit = fitDistortion(patches, degree, stop);
    if (round + 1 < kRounds) patches = patchesOf(images, false, result.fit.distortion);
  }
  result.patches = patches.size();
  result.rms = rmsBetween(result.fit.distortion, {});
  setDepths(patches, result);
  result.before = flatnessOf(held, {}, result.fit.scale);
  result.after = flatnessOf(held, result.fit.distortion, result.fit.scale);
  for (std::size_t i = 0; i < result.before.rms_of_image.size(); ++i)
    result.flatter_images += result.after.rms_of_image[i] < result.before.rms_of_image[i];
  refuseWhatIsNoBetter(result);
  result.halves_differ_rms = differenceOfHalves(patches, images.size(), degree, stop);
  return result;
}

}  // namespace omnimapper::calibration
