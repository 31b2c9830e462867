#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Progress.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "SaliencyProposer.h"
#include "SignClassifier.h"
#include "TrainingPictures.h"

namespace omnimapper::signs {

struct SignTrainingOptions {
  double cost = 10;        ///< C of the support vector machine, the cost of a region on the wrong side
  double gamma = 1;        ///< of the kernel, as in SignModel
  int folds = 3;           ///< number of folds of the cross-validation
  int others = 30;         ///< largest number of regions without a sign that are drawn from each picture
  double min_score = 0.3;  ///< probability above which a region counts as a sign in the tables
  int seed = 1;
  HogOptions hog;
  SaliencyOptions saliency;

  static const base::OptionTable<SignTrainingOptions>& table();
};

/// A region of a training picture: either a sign, or a region that does not show a sign.
struct LabelledRegion {
  SignFeatures features;
  bool is_sign = false;
  std::string group;  ///< the sign, or else the picture; a group is never in both training and test
};

/// The regions that the proposer found in the pictures of a building.
struct RegionSet {
  std::string name;
  int pictures = 0;
  int signs = 0;  ///< number of signs in the pictures that count (see counts())
  int found = 0;  ///< number of these signs that some region overlaps by at least half
  std::vector<LabelledRegion> regions;
};

/// Proposes regions in all pictures and labels them. The overlap of a region and a true sign is the intersection over
/// union of their upright boxes. A region is labelled as a sign if the largest overlap is at least 0.5, and as no sign
/// if it is below 0.3. Regions in between are left out, and so are regions that touch a sign that does not count (see
/// counts()). Throws as SignDetector::detect(), and Error(interrupted) when `stop` returns true.
RegionSet gatherRegions(const TrainingSet& set, const SignTrainingOptions& options, base::Progress& progress,
                        const std::function<bool()>& stop = {});

/// Trains a support vector machine (C-SVC of OpenCV) on all regions. To map decision values to probabilities, machines
/// are trained on all folds but one and applied to the remaining fold; the mapping is fitted to these decision values,
/// with equal weight for both classes (Platt: Probabilistic outputs for support vector machines, 1999; by the method of
/// Lin, Lin, Weng: A note on Platt's probabilistic outputs, 2007). The same regions and options give the same bits.
/// Throws Error(unreadable_input) if there are too few regions: at least two folds must contain signs, and at least two
/// must contain other regions.
SignClassifier trainClassifier(const std::vector<const RegionSet*>& sets, const SignTrainingOptions& options);

/// How often a classifier is right.
struct SignRates {
  int signs = 0, others = 0;              ///< number of regions with a sign, and without one
  int signs_right = 0, others_right = 0;  ///< number of these that were classified correctly

  double truePositive() const { return signs > 0 ? static_cast<double>(signs_right) / signs : 0; }
  double trueNegative() const { return others > 0 ? static_cast<double>(others_right) / others : 0; }
};
SignRates tryClassifier(const SignClassifier& classifier, const RegionSet& set, double min_score);

/// One row of the thesis's Tables 6 and 7: the sets that a classifier was trained on, and its rates.
struct SignTrial {
  std::string name;               ///< of the set, or of all sets together
  SignRates cross_validated;      ///< over the folds of the sets that the classifier was trained on (Table 6)
  int vectors = 0;                ///< number of support vectors of the classifier that was trained on all folds
  std::vector<SignRates> across;  ///< on each set (Table 7); on the sets of the training, over the folds
};
/// A row for each set and, if there are several sets, a row for all of them together. Throws as trainClassifier().
std::vector<SignTrial> crossValidate(const std::vector<RegionSet>& sets, const SignTrainingOptions& options,
                                     base::Progress& progress, const std::function<bool()>& stop = {});

/// Both tables, and the counts of the regions, as text.
std::string toText(const std::vector<RegionSet>& sets, const std::vector<SignTrial>& trials);

}  // namespace omnimapper::signs
