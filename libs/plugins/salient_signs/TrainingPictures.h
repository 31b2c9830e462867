#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/signs/SignDetector.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::signs {

/// A door sign that a training picture shows (ground truth).
struct TrueSign {
  std::string sign;  ///< name of the sign, the same in all pictures that show it; empty: not known
  Corners corners_px;
  double visible = 1;  ///< share of the sign that is in the picture and not hidden
};

/// Whether a detector is expected to find the sign: at least 0.9 of it is visible, and it is at least 24 px high.
bool counts(const TrueSign& sign);

/// A picture with all signs that it shows at least in part.
struct TrainingPicture {
  std::string name;
  std::function<mrpt::img::CImage()> load;  ///< called when the pixels are needed; from one thread at a time
  std::vector<TrueSign> signs;
};

/// The pictures of one building.
struct TrainingSet {
  std::string name;
  std::vector<TrainingPicture> pictures;
};

/// Reads the pictures (.jpg, .jpeg, .png) of a folder, sorted by name, with their signs from either of
///
/// - signs.csv, whose first line names its columns, in any order: `image` (a file of the folder), `x1`, `y1` to `x4`,
///   `y4` (the corners: upper left, upper right, lower right, lower left as the sign is read [px]), and, if known,
///   `sign` (its name, so that no sign is in both training and test) and `visible` (share of it that the picture shows,
///   0 to 1). Each sign has a line; a picture without a line shows no sign. Other columns are skipped.
/// - NAME.mask.png beside each picture NAME.jpg, .jpeg or .png and of the same size, in which signs are white. Pictures
///   without a mask are left out.
///
/// The set is named after the folder. Throws Error(unreadable_input), naming file and line, for a folder that is
/// missing or has neither signs.csv nor masks, a picture that is missing, or a line that is not of this form.
TrainingSet readTrainingFolder(const std::string& folder);

}  // namespace omnimapper::signs
