#pragma once

#include <omnimapper/signs/TextReader.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// What tells how far the reading of a line can be trusted.
struct ReadingEvidence {
  double weakest_letter = 0;  ///< least probability of a letter by the reader's own word, in all readings that agree
  double agreement = 0;       ///< share of the readings, of larger and smaller patches, that have the same text
  /// How much of the text's background is beside it, at the end that has less, in heights of the line's box, at most
  /// 0.5. A text that the end of the image cuts, or something before it, has none there.
  double clearance = 0;
  double height_px = 0;  ///< of the line's box in the picture
};

struct LineReading {
  std::string text;  ///< UTF-8, without blanks at its ends
  ReadingEvidence evidence;
};

/// Reads a line in a picture several times, in patches that hold more or less of what is about it and with its contrast
/// stretched, and takes what most say: a line whose box leaves a letter out, or holds a screw beside the text, is not
/// read the same in all. A network is often sure of what is wrong, so what counts is how far these readings agree.
LineReading readLine(const cv::Mat& picture, const Corners& line, const TextReader& reader);

struct ReadLine {
  Corners quad;
  LineReading reading;
};

/// Reads a text in a picture that should be one line. Where that is not sure and there may be two lines in it, one
/// above the other, which a detector that sees the picture made small takes for one, these are read too, and taken if
/// they are surer in the mean. From the top; none that has no text.
std::vector<ReadLine> readLines(const cv::Mat& picture, const Corners& text, const TextReader& reader);

/// How likely a reading is right, 0 to 1: at least 0.9 means that one in a hundred is wrong. What it was chosen on and
/// how well it holds: doc/results/signs.md.
double confidenceOf(const ReadingEvidence& evidence);

/// The patch that a quadrilateral shows, upright; empty for one without a pixel.
cv::Mat patchOf(const cv::Mat& picture, const Corners& quad);

}  // namespace omnimapper::signs
