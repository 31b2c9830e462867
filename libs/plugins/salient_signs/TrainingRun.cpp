#include "TrainingRun.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "Pixels.h"
#include "Plate.h"
#include "SalientSignDetector.h"

namespace omnimapper::signs {

namespace {

bool isOn(const Corners& region, const Corners& sign) {
  Eigen::Vector2f middle = Eigen::Vector2f::Zero();
  std::vector<cv::Point2f> outline;
  for (std::size_t i = 0; i < 4; ++i) {
    middle += 0.25f * region[i];
    outline.emplace_back(sign[i].x(), sign[i].y());
  }
  return cv::pointPolygonTest(outline, {middle.x(), middle.y()}, false) >= 0;
}

std::string trialText(const TrainingSet& set, const std::vector<PictureTrial>& trials) {
  std::string text = set.name + "\npicture, signs, found, overlap, false alarms, best score on a sign\n";
  PictureTrial sum;
  for (const PictureTrial& trial : trials) {
    text += trial.name + ", " + std::to_string(trial.signs) + ", " + std::to_string(trial.found) + ", " +
            base::fixed(trial.overlap, 2) + ", " + std::to_string(trial.false_alarms) + ", " +
            base::fixed(trial.best_score, 2) + "\n";
    sum.signs += trial.signs, sum.found += trial.found, sum.false_alarms += trial.false_alarms;
    sum.overlap += trial.overlap * trial.found;
  }
  return text + "all " + std::to_string(trials.size()) + ", " + std::to_string(sum.signs) + ", " +
         std::to_string(sum.found) + ", " + base::fixed(sum.found > 0 ? sum.overlap / sum.found : 0, 2) + ", " +
         std::to_string(sum.false_alarms) + "\n";
}

std::string runTrial(const TrainingRequest& request, const std::vector<TrainingSet>& sets) {
  SalientSignOptions options;
  options.min_score = request.options.min_score;
  options.saliency = request.options.saliency;
  const SalientSignDetector detector(
      options, request.trial == "shipped" ? SignClassifier::known() : SignClassifier::read(request.trial));
  std::string text;
  for (const TrainingSet& set : sets) text += trialText(set, tryDetector(detector, set));
  return text;
}

}  // namespace

std::vector<PictureTrial> tryDetector(const SignDetector& detector, const TrainingSet& set) {
  std::vector<PictureTrial> trials;
  for (const TrainingPicture& picture : set.pictures) {
    const mrpt::img::CImage image = picture.load();
    PictureTrial trial;
    trial.name = picture.name;
    const auto regions = detector.detect(pixelsOf(image));
    for (const SignRegion& region : regions) {
      const auto lies = [&](const TrueSign& sign) { return isOn(region.corners_px, sign.corners_px); };
      const bool on_sign = std::any_of(picture.signs.begin(), picture.signs.end(), lies);
      trial.false_alarms += !on_sign;
      if (on_sign) trial.best_score = std::max(trial.best_score, region.score);
    }
    for (const TrueSign& sign : picture.signs) {
      if (!counts(sign)) continue;
      ++trial.signs;
      double overlap = -1;
      for (const SignRegion& region : regions) {
        if (isOn(region.corners_px, sign.corners_px))
          overlap = std::max(overlap, overlapOf(boundsOf(region.corners_px), boundsOf(sign.corners_px)));
      }
      if (overlap < 0) continue;
      ++trial.found;
      trial.overlap += overlap;
    }
    if (trial.found > 0) trial.overlap /= trial.found;
    trials.push_back(trial);
  }
  return trials;
}

std::string runTraining(const TrainingRequest& request, base::Progress& progress, const std::function<bool()>& stop) {
  std::vector<TrainingSet> sets;
  for (const std::string& folder : request.folders) sets.push_back(readTrainingFolder(folder));
  if (!request.trial.empty()) return runTrial(request, sets);
  std::vector<RegionSet> regions;
  for (const TrainingSet& set : sets) regions.push_back(gatherRegions(set, request.options, progress, stop));
  const auto trials = crossValidate(regions, request.options, progress, stop);
  if (!request.output.empty()) {
    std::vector<const RegionSet*> all;
    for (const RegionSet& set : regions) all.push_back(&set);
    trainClassifier(all, request.options).write(request.output);
  }
  return toText(regions, trials);
}

}  // namespace omnimapper::signs
