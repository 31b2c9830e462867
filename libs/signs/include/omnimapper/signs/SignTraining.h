#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/signs/SaliencyProposer.h>
#include <omnimapper/signs/SignClassifier.h>
#include <omnimapper/signs/TrainingPictures.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::signs {

struct SignTrainingOptions {
  double cost = 10;        ///< C of the support vector machine: what a region on the wrong side costs
  double gamma = 1;        ///< of the kernel, as SignModel's
  int folds = 3;           ///< of cross-validation
  int others = 30;         ///< regions that are no signs, of a picture at most, chosen by chance
  double min_score = 0.3;  ///< above this a probability counts as a sign in the tables
  int seed = 1;
  HogOptions hog;
  SaliencyOptions saliency;

  static const base::OptionTable<SignTrainingOptions>& table();
};

/// A region of a training picture that is a sign, or nothing of one.
struct LabelledRegion {
  SignFeatures features;
  bool is_sign = false;
  std::string group;  ///< regions of one group are never both learnt and tried: the sign, else the picture
};

/// What the proposer found in the pictures of a building.
struct RegionSet {
  std::string name;
  int pictures = 0;
  int signs = 0;  ///< in the pictures, that count (see counts())
  int found = 0;  ///< of them, with a region that overlaps by half
  std::vector<LabelledRegion> regions;
};

/// A region is a sign if its upright box and that of a true sign share at least half of what they cover together. It is
/// none if they share less than 0.3; what is between, or on a sign that is hidden, cut off or too small, is left out.
/// Throws as SignDetector::detect(), and Error(interrupted) when `stop` says so.
RegionSet gatherRegions(const TrainingSet& set, const SignTrainingOptions& options, base::Progress& progress,
                        const std::function<bool()>& stop = {});

/// A support vector machine (OpenCV's, C-SVC) on all regions; its probability is fitted to what machines trained on the
/// other folds say of each fold (Platt: Probabilistic outputs for support vector machines, 1999; by Lin, Lin, Weng: A
/// note on Platt's probabilistic outputs, 2007), both classes weighing the same. The same regions and options give the
/// same bits. Throws Error(unreadable_input) unless there are two groups of signs and two of others.
SignClassifier trainClassifier(const std::vector<const RegionSet*>& sets, const SignTrainingOptions& options);

/// How often a classifier is right.
struct SignRates {
  int signs = 0, others = 0;            ///< regions
  int signs_told = 0, others_told = 0;  ///< of them, rightly

  double truePositive() const { return signs > 0 ? static_cast<double>(signs_told) / signs : 0; }
  double trueNegative() const { return others > 0 ? static_cast<double>(others_told) / others : 0; }
};
SignRates tryClassifier(const SignClassifier& classifier, const RegionSet& set, double min_score);

/// One row of the thesis's Tables 6 and 7: who was trained on, and how it does.
struct SignTrial {
  std::string name;               ///< of the set, or of all sets together
  SignRates cross_validated;      ///< over the folds of what it was trained on (Table 6)
  int vectors = 0;                ///< support vectors of the classifier of all
  std::vector<SignRates> across;  ///< on each set in turn (Table 7); on sets that it was trained on, over the folds
};
/// A row for each set, and one for all of them if there are several. Throws as trainClassifier().
std::vector<SignTrial> crossValidate(const std::vector<RegionSet>& sets, const SignTrainingOptions& options,
                                     base::Progress& progress, const std::function<bool()>& stop = {});

/// Both tables, and what was found, as text.
std::string toText(const std::vector<RegionSet>& sets, const std::vector<SignTrial>& trials);

}  // namespace omnimapper::signs
