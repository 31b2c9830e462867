#include "SignTraining.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/SplitMix.h>

#include <algorithm>

#include "Machine.h"
#include "Pixels.h"
#include "Plate.h"

namespace omnimapper::signs {

namespace {

// A region with at least the first overlap with a sign is that sign; with less than the second it is none.
constexpr double kSignOverlap = 0.5, kOtherOverlap = 0.3;

struct Sign {
  cv::Rect2f box;
  bool counts;
  std::string group;
};

std::vector<Sign> signsOf(const TrainingPicture& picture, const std::string& set) {
  std::vector<Sign> signs;
  for (const TrueSign& sign : picture.signs) {
    const cv::Rect2f box = boundsOf(sign.corners_px);
    signs.push_back({box, counts(sign), set + (sign.sign.empty() ? "/picture " + picture.name : "/sign " + sign.sign)});
  }
  return signs;
}

enum class Verdict { sign, other, unclear };

std::pair<Verdict, const Sign*> verdictOn(const cv::Rect2f& region, const std::vector<Sign>& signs) {
  const Sign* best = nullptr;
  double overlap = 0;
  for (const Sign& sign : signs) {
    if (!sign.counts && (sign.box & region).area() > 0) return {Verdict::unclear, nullptr};
    if (sign.counts && overlapOf(sign.box, region) > overlap) {
      best = &sign;
      overlap = overlapOf(sign.box, region);
    }
  }
  if (overlap >= kSignOverlap) return {Verdict::sign, best};
  return {overlap < kOtherOverlap ? Verdict::other : Verdict::unclear, nullptr};
}

// Keeps `count` of the regions, drawn at random, in their order.
void keepSome(std::vector<Corners>& regions, int count, base::SplitMix& random) {
  while (static_cast<int>(regions.size()) > count)
    regions.erase(regions.begin() + random.below(static_cast<int>(regions.size())));
}

void add(const TrainingPicture& picture, const SignTrainingOptions& options, base::SplitMix& random, RegionSet& set) {
  const mrpt::img::CImage image = picture.load();
  const camera::ColourImage pixels = pixelsOf(image);
  const std::vector<Sign> signs = signsOf(picture, set.name);
  std::vector<Corners> regions, others;
  std::vector<const Sign*> of_regions;
  for (const Corners& corners : SaliencyProposer(options.saliency).propose(pixels)) {
    const auto [verdict, sign] = verdictOn(boundsOf(corners), signs);
    if (verdict == Verdict::other) others.push_back(corners);
    if (verdict != Verdict::sign) continue;
    regions.push_back(corners);
    of_regions.push_back(sign);
  }
  for (const Sign& sign : signs) {
    set.signs += sign.counts;
    set.found += std::find(of_regions.begin(), of_regions.end(), &sign) != of_regions.end();
  }
  keepSome(others, options.others, random);
  regions.insert(regions.end(), others.begin(), others.end());
  const auto features = describe(pixels, regions, options.hog);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const bool is_sign = i < of_regions.size();
    set.regions.push_back(
        {features[i], is_sign, is_sign ? of_regions[i]->group : set.name + "/picture " + picture.name});
  }
}

std::vector<const LabelledRegion*> regionsOf(const std::vector<const RegionSet*>& sets) {
  std::vector<const LabelledRegion*> regions;
  for (const RegionSet* set : sets) {
    for (const LabelledRegion& region : set->regions) regions.push_back(&region);
  }
  return regions;
}

void countIn(const SignClassifier& classifier, const LabelledRegion& region, double min_score, SignRates& rates) {
  const bool is_right = (classifier.probability(region.features) > min_score) == region.is_sign;
  ++(region.is_sign ? rates.signs : rates.others);
  (region.is_sign ? rates.signs_right : rates.others_right) += is_right;
}

}  // namespace

const base::OptionTable<SignTrainingOptions>& SignTrainingOptions::table() {
  using base::Range;
  using O = SignTrainingOptions;
  static const auto table =
      base::OptionTable<O>()
          .number("cost", &O::cost, Range::positive(),
                  "Cost C of the support vector machine for a region on the wrong side.")
          .number("gamma", &O::gamma, Range::positive(),
                  "Parameter gamma of the support vector machine's kernel, exp(-gamma |x - y|^2).")
          .integer("folds", &O::folds, {2, 100}, "Number of folds of the cross-validation.")
          .integer("others", &O::others, {1, 100000},
                   "Largest number of regions without a sign that are taken from each picture.")
          .number("min_score", &O::min_score, {0, 1},
                  "Probability above which a region counts as a sign in the tables.")
          .integer("seed", &O::seed, Range::notNegative(),
                   "Seed of the random numbers by which the folds and the regions without a sign are drawn.");
  return table;
}

RegionSet gatherRegions(const TrainingSet& set, const SignTrainingOptions& options, base::Progress& progress,
                        const std::function<bool()>& stop) {
  RegionSet regions;
  regions.name = set.name;
  base::SplitMix random(static_cast<std::uint64_t>(options.seed));
  for (const TrainingPicture& picture : set.pictures) {
    if (stop && stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
    progress.report(1.0 * regions.pictures / static_cast<double>(set.pictures.size()), "pictures of " + set.name);
    add(picture, options, random, regions);
    ++regions.pictures;
  }
  return regions;
}

SignClassifier trainClassifier(const std::vector<const RegionSet*>& sets, const SignTrainingOptions& options) {
  return trainOn(regionsOf(sets), options);
}

SignRates tryClassifier(const SignClassifier& classifier, const RegionSet& set, double min_score) {
  SignRates rates;
  for (const LabelledRegion& region : set.regions) countIn(classifier, region, min_score, rates);
  return rates;
}

namespace {

// The rates of each set, when each fold is classified by a machine that was trained on the other folds.
std::vector<SignRates> overFolds(const std::vector<const RegionSet*>& sets, const SignTrainingOptions& options) {
  std::vector<SignRates> rates(sets.size());
  for (int fold = 0; fold < options.folds; ++fold) {
    std::vector<const LabelledRegion*> learnt;
    for (const LabelledRegion* region : regionsOf(sets)) {
      if (foldOf(*region, options, FoldsOf::trial) != fold) learnt.push_back(region);
    }
    const SignClassifier classifier = trainOn(learnt, options);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      for (const LabelledRegion& region : sets[i]->regions) {
        if (foldOf(region, options, FoldsOf::trial) == fold) countIn(classifier, region, options.min_score, rates[i]);
      }
    }
  }
  return rates;
}

SignTrial tryOut(const std::vector<const RegionSet*>& learnt, const std::vector<RegionSet>& all,
                 const SignTrainingOptions& options) {
  SignTrial trial;
  for (const RegionSet* set : learnt) trial.name += (trial.name.empty() ? "" : " + ") + set->name;
  const std::vector<SignRates> folds = overFolds(learnt, options);
  const SignClassifier classifier = trainClassifier(learnt, options);
  trial.vectors = static_cast<int>(classifier.model().vectors.size());
  for (const RegionSet& set : all) {
    const auto place = std::find(learnt.begin(), learnt.end(), &set);
    trial.across.push_back(place == learnt.end() ? tryClassifier(classifier, set, options.min_score)
                                                 : folds[static_cast<std::size_t>(place - learnt.begin())]);
  }
  for (const SignRates& fold : folds) {
    trial.cross_validated.signs += fold.signs, trial.cross_validated.others += fold.others;
    trial.cross_validated.signs_right += fold.signs_right, trial.cross_validated.others_right += fold.others_right;
  }
  return trial;
}

}  // namespace

std::vector<SignTrial> crossValidate(const std::vector<RegionSet>& sets, const SignTrainingOptions& options,
                                     base::Progress& progress, const std::function<bool()>& stop) {
  std::vector<std::vector<const RegionSet*>> rows;
  for (const RegionSet& set : sets) rows.push_back({&set});
  if (sets.size() > 1) {
    rows.emplace_back();
    for (const RegionSet& set : sets) rows.back().push_back(&set);
  }
  std::vector<SignTrial> trials;
  for (const auto& row : rows) {
    if (stop && stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was written");
    progress.report(1.0 * static_cast<double>(trials.size()) / static_cast<double>(rows.size()), "cross-validation");
    trials.push_back(tryOut(row, sets, options));
  }
  return trials;
}

}  // namespace omnimapper::signs
