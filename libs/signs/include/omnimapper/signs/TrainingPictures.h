#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/signs/SignDetector.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::signs {

/// A door sign that a training picture truly shows.
struct TrueSign {
  std::string sign;  ///< which one: the same name in every picture of it; empty: not known
  Corners corners_px;
  double visible = 1;  ///< part of it that is in the picture and not hidden
};

/// Whether it can be asked of a detector: at least 0.9 of it is visible, and 24 px high.
bool counts(const TrueSign& sign);

/// A picture with all signs that it shows something of.
struct TrainingPicture {
  std::string name;
  std::function<mrpt::img::CImage()> load;  ///< called when its pixels are needed; from one thread at a time
  std::vector<TrueSign> signs;
};

/// The pictures of one building.
struct TrainingSet {
  std::string name;
  std::vector<TrainingPicture> pictures;
};

/// The pictures (.jpg, .jpeg, .png) of a folder, sorted by name, with their signs from either of
///
/// - signs.csv, whose first line names its columns, in any order: `image` (a file of the folder), `x1`, `y1` to `x4`,
///   `y4` (the corners: upper left, upper right, lower right, lower left as the sign is read [px]), and, if known,
///   `sign` (which one it is, so that no sign is both learnt and tried) and `visible` (part of it that the picture
///   shows, 0 to 1). A line for each sign; a picture without a line shows none. Other columns are skipped.
/// - NAME.mask.png beside each picture NAME, of its size: signs are white. Pictures without a mask are left out.
///
/// The set is named after the folder. Throws Error(unreadable_input), naming file and line, for a folder that is
/// missing or has neither, a picture that is not there, or a line that is not of this form.
TrainingSet readTrainingFolder(const std::string& folder);

}  // namespace omnimapper::signs
