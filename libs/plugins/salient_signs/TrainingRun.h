#pragma once

#include <functional>
#include <string>
#include <vector>

#include "SignTraining.h"

namespace omnimapper::signs {

struct TrainingRequest {
  std::vector<std::string> folders;  ///< of pictures, one for each building; see readTrainingFolder()
  std::string output;                ///< file to write the model to; empty: none is written
  std::string trial;  ///< model file, or "shipped"; if given, this model is tried on the folders and nothing is trained
  SignTrainingOptions options;
};

/// Trains on all folders and writes the model; returns the tables. With `trial`, trains nothing and returns how well
/// that model finds the signs of each picture. Throws as readTrainingFolder(), trainClassifier(),
/// SignClassifier::read() and base::writeFile().
std::string runTraining(const TrainingRequest& request, base::Progress& progress,
                        const std::function<bool()>& stop = {});

/// How well a detector finds the signs of a picture.
struct PictureTrial {
  std::string name;
  int signs = 0;          ///< number of signs that count, as in RegionSet
  int found = 0;          ///< number of these signs on which the middle of a reported region lies
  double overlap = 0;     ///< mean overlap of the upright boxes of region and sign, for the signs found
  int false_alarms = 0;   ///< number of reported regions whose middle is on no sign
  double best_score = 0;  ///< best score of a region on a sign
};
std::vector<PictureTrial> tryDetector(const SignDetector& detector, const TrainingSet& set);

}  // namespace omnimapper::signs
