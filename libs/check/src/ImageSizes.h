#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation.h>
#include <omnimapper/check/LogFacts.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::check {

/// The size (columns, rows) [px] of the images for which a camera was calibrated, if this is not `columns` x `rows`.
/// What a log states as the size is often a default, so the image's centre decides: in the images of a calibration the
/// optical axis is near it. None if the size is right, or if the camera is not calibrated.
std::optional<std::pair<double, double>> otherCalibratedSize(const mrpt::img::TCamera& camera, double columns,
                                                             double rows);

/// Compares the sizes of colour and depth images with those of their calibrations.
class ImageSizes {
 public:
  void add(const mrpt::obs::CObservation& observation);
  /// Images of a label and a kind of which more than half have another size, as the first of them shows it.
  std::vector<ImageSizeFacts> facts() const;

 private:
  struct Counted {
    std::size_t images = 0, wrong = 0;
    ImageSizeFacts first;
  };
  void add(const std::string& label, bool is_depth, const mrpt::img::TCamera& camera, double columns, double rows);

  std::map<std::pair<std::string, bool>, Counted> counted_;  // by label and whether the image holds depths
};

}  // namespace omnimapper::check
