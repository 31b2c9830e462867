#pragma once

#include <omnimapper/signs/TextReader.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// Measures that determine how far the reading of a line can be trusted.
struct ReadingEvidence {
  double weakest_letter = 0;  ///< smallest probability that the reader gives a letter, in all agreeing readings
  double agreement = 0;       ///< share of the readings (of larger and smaller patches) that have this text
  /// Width of the clear background beside the text, at the end that has less of it, in heights of the line's box; at
  /// most 0.5. A text that is cut by the edge of the image, or by an object in front of it, has none there.
  double clearance = 0;
  double height_px = 0;  ///< of the line's box in the picture
};

struct LineReading {
  std::string text;  ///< UTF-8, without blanks at its ends
  ReadingEvidence evidence;
};

/// Reads a line in a picture several times, in patches with more or less of its surroundings and with stretched
/// contrast, and returns the text for which most readings speak, weighted by their probabilities. If the box leaves a
/// letter out, or holds a screw beside the text, the readings differ. A network is often sure of a wrong text, so the
/// agreement of the readings is what counts.
LineReading readLine(const cv::Mat& picture, const Corners& line, const TextReader& reader);

struct ReadLine {
  Corners quad;
  LineReading reading;
};

/// Reads a text in a picture that should be one line. A detector that works on a small copy of the picture may take two
/// lines, one above the other, for one; so if the reading is uncertain and the text can be split, the parts are read
/// too, and returned if their mean confidence is higher. Lines are sorted from the top, and those without text left
/// out.
std::vector<ReadLine> readLines(const cv::Mat& picture, const Corners& text, const TextReader& reader);

/// Probability that a reading is right, 0 to 1: of the readings with at least 0.9, one in a hundred is wrong.
/// doc/results/signs.md says on which data the formula was chosen and how well it holds.
double confidenceOf(const ReadingEvidence& evidence);

/// The upright patch of a quadrilateral; empty if a side is shorter than 2 px or longer than 4096 px.
cv::Mat patchOf(const cv::Mat& picture, const Corners& quad);

}  // namespace omnimapper::signs
