#pragma once

#include <vector>

#include "SignTraining.h"

namespace omnimapper::signs {

/// Trains a support vector machine on these regions, which must contain both signs and others; its probability is not
/// fitted yet.
SignModel trainMachine(const std::vector<const LabelledRegion*>& regions, const SignTrainingOptions& options);

/// Purpose of the folds: those of the cross-validation, or those on which the probability is fitted. The two divisions
/// are independent of each other.
enum class FoldsOf { trial, calibration };
/// The fold of a region, 0 to folds - 1; it follows from the name of the region's group and the seed.
int foldOf(const LabelledRegion& region, const SignTrainingOptions& options, FoldsOf what);

/// As trainClassifier(), for a list of regions.
SignClassifier trainOn(const std::vector<const LabelledRegion*>& regions, const SignTrainingOptions& options);

}  // namespace omnimapper::signs
