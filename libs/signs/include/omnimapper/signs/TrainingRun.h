#pragma once

#include <omnimapper/signs/SignTraining.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::signs {

struct TrainingRequest {
  std::vector<std::string> folders;  ///< of pictures, one for each building: readTrainingFolder()
  std::string output;                ///< file of the model; empty: none is written
  std::string trial;                 ///< file of a model; if given, that is tried on the folders and nothing is trained
  SignTrainingOptions options;
};

/// Trains on all folders and writes the model; returns the tables. With `trial`, how well that finds the signs of each
/// picture. Throws as readTrainingFolder(), trainClassifier(), SignClassifier::read() and base::writeFile().
std::string runTraining(const TrainingRequest& request, base::Progress& progress,
                        const std::function<bool()>& stop = {});

/// How well a detector does on a picture.
struct PictureTrial {
  std::string name;
  int signs = 0;          ///< that count, as RegionSet's
  int found = 0;          ///< of them, with the middle of a reported region on the sign
  double overlap = 0;     ///< of the upright boxes of the signs that were found, mean
  int false_alarms = 0;   ///< reported regions whose middle is on no sign
  double best_score = 0;  ///< of a region on a sign
};
std::vector<PictureTrial> tryDetector(const SignDetector& detector, const TrainingSet& set);

}  // namespace omnimapper::signs
