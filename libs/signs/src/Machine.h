#pragma once

#include <omnimapper/signs/SignTraining.h>

#include <vector>

namespace omnimapper::signs {

/// The support vector machine of these regions, which hold signs and others; its probability is not fitted yet.
SignModel trainMachine(const std::vector<const LabelledRegion*>& regions, const SignTrainingOptions& options);

/// Folds of a cross-validation, and of those within its folds, which are others.
enum class FoldsOf { trial, calibration };
/// The fold of a group's regions, 0 to folds - 1; its name and the seed decide it.
int foldOf(const LabelledRegion& region, const SignTrainingOptions& options, FoldsOf what);

/// trainClassifier() of regions.
SignClassifier trainOn(const std::vector<const LabelledRegion*>& regions, const SignTrainingOptions& options);

}  // namespace omnimapper::signs
