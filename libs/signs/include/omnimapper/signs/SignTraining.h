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
  double cost = 10;        ///< C of the support vector machine, the cost of a region on the wrong side
  double gamma = 1;        ///< of the kernel, as in SignModel
  int folds = 3;           ///< number of folds of the cross-validation
  int others = 30;         ///< largest number of regions without a sign of each picture, drawn at random
  double min_score = 0.3;  ///< probability above which a region counts as a sign in the tables
  int seed = 1;
  HogOptions hog;
  SaliencyOptions saliency;

  static const base::OptionTable<SignTrainingOptions>& table();
};

/// A region of a training picture, which is a sign or shows nothing of one.
struct LabelledRegion {
  SignFeatures features;
  bool is_sign = false;
  std::string group;  ///< the sign, else the picture; regions of one group are never in both training and test
};

/// The regions that the proposer found in the pictures of a building.
struct RegionSet {
  std::string name;
  int pictures = 0;
  int signs = 0;  ///< number of signs in the pictures that count (see counts())
  int found = 0;  ///< number of these signs with a region that overlaps by at least half
  std::vector<LabelledRegion> regions;
};

/// Proposes regions in all pictures and labels them. A region is a sign if its upright box and that of a true sign have
/// an intersection over union of at least 0.5, and it is none below 0.3. Regions in between, and regions on a sign that
/// is hidden, cut off or too small, are left out. Throws as SignDetector::detect(), and Error(interrupted) when `stop`
/// returns true.
RegionSet gatherRegions(const TrainingSet& set, const SignTrainingOptions& options, base::Progress& progress,
                        const std::function<bool()>& stop = {});

/// Trains a support vector machine (C-SVC of OpenCV) on all regions. Its probability is fitted to the decision values
/// of each fold, which come from machines trained on the other folds, with equal weight for both classes (Platt:
/// Probabilistic outputs for support vector machines, 1999; by Lin, Lin, Weng: A note on Platt's probabilistic outputs,
/// 2007). The same regions and options give the same bits. Throws Error(unreadable_input) unless there are two groups
/// of signs and two of others.
SignClassifier trainClassifier(const std::vector<const RegionSet*>& sets, const SignTrainingOptions& options);

/// How often a classifier is right.
struct SignRates {
  int signs = 0, others = 0;              ///< number of regions with a sign, and of others
  int signs_right = 0, others_right = 0;  ///< number of these that were classified correctly

  double truePositive() const { return signs > 0 ? static_cast<double>(signs_right) / signs : 0; }
  double trueNegative() const { return others > 0 ? static_cast<double>(others_right) / others : 0; }
};
SignRates tryClassifier(const SignClassifier& classifier, const RegionSet& set, double min_score);

/// One row of the thesis's Tables 6 and 7: the sets that a classifier was trained on, and its rates.
struct SignTrial {
  std::string name;               ///< of the set, or of all sets together
  SignRates cross_validated;      ///< over the folds of the sets that it was trained on (Table 6)
  int vectors = 0;                ///< number of support vectors of the classifier that was trained on all folds
  std::vector<SignRates> across;  ///< on each set (Table 7); on sets that it was trained on, over the folds
};
/// A row for each set, and one for all of them if there are several. Throws as trainClassifier().
std::vector<SignTrial> crossValidate(const std::vector<RegionSet>& sets, const SignTrainingOptions& options,
                                     base::Progress& progress, const std::function<bool()>& stop = {});

/// Both tables, and the counts of the regions, as text.
std::string toText(const std::vector<RegionSet>& sets, const std::vector<SignTrial>& trials);

}  // namespace omnimapper::signs
