#include "LineReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "LineSplitting.h"

namespace omnimapper::signs {

namespace {

constexpr int kRows = 48;       // height of the patch in which the ends of a text are examined
constexpr double kClear = 0.5;  // largest clearance, as a share of the line's height
constexpr double kInk = 0.35;   // a pixel that differs by more than this share of the text's contrast is not background
constexpr int kDark = 3, kBright = 252;  // a pixel outside these grey levels shows nothing

struct Levels {
  double low, high;
};

// The grey levels below and above which `share` of the pixels are.
Levels levelsOf(const cv::Mat& grey, double share) {
  std::array<int, 256> counts{};
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column) ++counts[grey.at<std::uint8_t>(row, column)];
  const double wanted = share * static_cast<double>(grey.total());
  Levels levels{0, 255};
  for (double sum = 0; levels.low < 255 && (sum += counts[static_cast<std::size_t>(levels.low)]) < wanted;)
    ++levels.low;
  for (double sum = 0; levels.high > 0 && (sum += counts[static_cast<std::size_t>(levels.high)]) < wanted;)
    --levels.high;
  return levels;
}

cv::Mat inGrey(const cv::Mat& patch) {
  cv::Mat grey;
  cv::cvtColor(patch, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat stretched(const cv::Mat& patch) {
  const auto levels = levelsOf(inGrey(patch), 0.02);
  const double factor = 255 / std::max(8.0, levels.high - levels.low);
  cv::Mat result;
  patch.convertTo(result, CV_8U, factor, -levels.low * factor);
  return result;
}

camera::ColourImage viewOf(const cv::Mat& patch) {
  return {patch.data, patch.cols, patch.rows, static_cast<int>(patch.step), camera::ColourImage::Order::bgr};
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Whether a column shows only the background of a text.
bool isClear(const cv::Mat& grey, int column, double background, double contrast) {
  int shown = 0, other = 0;
  for (int row = 0; row < grey.rows; ++row) {
    const int level = grey.at<std::uint8_t>(row, column);
    shown += level > kDark && level < kBright;
    other += std::abs(level - background) > kInk * contrast;
  }
  return 2 * shown > grey.rows && 10 * other <= grey.rows;
}

double clearanceOf(const cv::Mat& picture, const Corners& line) {
  const Corners wide = grown(line, {1, 1, 0, 0});
  constexpr int rows = kRows;
  const int columns = cvRound(kRows * widthOf(wide) / std::max(1.0f, heightOf(line)));
  if (columns < 3 * kRows / 2 || columns > 100 * kRows) return 0;
  std::vector<cv::Point2f> from;
  for (const auto& corner : wide) from.emplace_back(corner.x(), corner.y());
  const float right = static_cast<float>(columns - 1), bottom = static_cast<float>(rows - 1);
  const std::vector<cv::Point2f> to{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  cv::Mat patch;  // outside the picture it is black, which shows nothing
  cv::warpPerspective(picture, patch, cv::getPerspectiveTransform(from, to), {columns, rows}, cv::INTER_LINEAR,
                      cv::BORDER_CONSTANT);
  const cv::Mat grey = inGrey(patch);
  // The grey levels of the letters, and of the background above and below them.
  constexpr int kBeside = kRows / 8;
  cv::Mat background;
  cv::vconcat(grey(cv::Rect(kRows, 0, columns - 2 * kRows, kBeside)),
              grey(cv::Rect(kRows, rows - kBeside, columns - 2 * kRows, kBeside)), background);
  const auto levels = levelsOf(grey(cv::Rect(kRows, 0, columns - 2 * kRows, rows)), 0.05);
  const double level = levelsOf(background, 0.5).low;
  const double contrast = std::max(1.0, levels.high - levels.low);
  // The longest clear stretch around the end of the line's box; this end may be within the last letter or beyond it.
  const auto clearanceFrom = [&](int first, int last) {
    int longest = 0, length = 0;
    for (int column = std::max(0, first); column <= std::min(last, columns - 1); ++column) {
      length = isClear(grey, column, level, contrast) ? length + 1 : 0;
      longest = std::max(longest, length);
    }
    return std::min(kClear, static_cast<double>(longest) / kRows);
  };
  constexpr int kWithin = kRows / 3, kBeyond = kRows / 2;
  return std::min(clearanceFrom(kRows - kBeyond, kRows + kWithin),
                  clearanceFrom(columns - kRows - kWithin, columns - kRows + kBeyond));
}

}  // namespace

cv::Mat patchOf(const cv::Mat& picture, const Corners& quad) {
  const int columns = static_cast<int>(widthOf(quad)), rows = static_cast<int>(heightOf(quad));
  constexpr int kLargest = 4096;
  if (picture.empty() || columns < 2 || rows < 2 || columns > kLargest || rows > kLargest) return {};
  std::vector<cv::Point2f> from;
  for (const auto& corner : quad) from.emplace_back(corner.x(), corner.y());
  const float right = static_cast<float>(columns), bottom = static_cast<float>(rows);
  const std::vector<cv::Point2f> to{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  cv::Mat patch;
  cv::warpPerspective(picture, patch, cv::getPerspectiveTransform(from, to), {columns, rows}, cv::INTER_CUBIC,
                      cv::BORDER_REPLICATE);
  return patch;
}

LineReading readLine(const cv::Mat& picture, const Corners& line, const TextReader& reader) {
  const cv::Mat tight = patchOf(picture, line), wide = patchOf(picture, grown(line, {0.3f, 0.3f, 0.08f, 0.08f})),
                widest = patchOf(picture, grown(line, {0.5f, 0.5f, 0.2f, 0.2f}));
  if (tight.empty() || wide.empty() || widest.empty()) return {};
  const std::array<cv::Mat, 4> patches{tight, wide, stretched(wide), stretched(widest)};
  struct Vote {
    std::string text;
    double weakest = 1, weight = 0;
    int count = 0;
  };
  std::vector<Vote> votes;
  for (const auto& patch : patches) {
    const auto reading = reader.read(viewOf(patch));
    const auto text = trimmed(reading.text);
    if (text.empty()) continue;
    const double weakest =
        std::min(reading.of_left_out, *std::min_element(reading.probabilities.begin(), reading.probabilities.end()));
    auto vote = std::find_if(votes.begin(), votes.end(), [&](const Vote& v) { return v.text == text; });
    if (vote == votes.end()) vote = votes.insert(vote, {text, 1, 0, 0});
    vote->weakest = std::min(vote->weakest, weakest);
    vote->weight += weakest;
    ++vote->count;
  }
  if (votes.empty()) return {};
  const auto& best =
      *std::max_element(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.weight < b.weight; });
  return {best.text,
          {best.weakest, static_cast<double>(best.count) / static_cast<double>(patches.size()),
           clearanceOf(picture, line), static_cast<double>(heightOf(line))}};
}

std::vector<ReadLine> readLines(const cv::Mat& picture, const Corners& text, const TextReader& reader) {
  constexpr double kSure = 0.9;
  std::vector<ReadLine> whole{{text, readLine(picture, text, reader)}};
  const double confidence = confidenceOf(whole.front().reading.evidence);
  if (whole.front().reading.text.empty()) whole.clear();
  if (!whole.empty() && confidence >= kSure) return whole;
  std::vector<ReadLine> parts;
  double sum = 0;
  int tried = 0;  // a part without text counts with a confidence of 0
  for (const auto& part : partsOf(picture, text)) {
    auto lines = readLines(picture, part, reader);
    tried += lines.empty() ? 1 : static_cast<int>(lines.size());
    for (auto& line : lines) {
      sum += confidenceOf(line.reading.evidence);
      parts.push_back(std::move(line));
    }
  }
  const bool are_surer = !parts.empty() && (whole.empty() || sum / tried > confidence);
  return are_surer ? parts : whole;
}

// If all readings of a line agree and it has clear background at both ends, it is nearly always right, whatever
// probabilities the reader gives its letters. Without clear background one in seven is wrong, because letters are
// missing.
double confidenceOf(const ReadingEvidence& evidence) {
  constexpr double kClearEnough = 0.2, kIfNotClear = 0.85;
  constexpr double kOfWeakest = 0.15, kOfAgreement = 1.5;
  const double confidence = std::pow(evidence.weakest_letter, kOfWeakest) * std::pow(evidence.agreement, kOfAgreement);
  return std::clamp(evidence.clearance < kClearEnough ? kIfNotClear * confidence : confidence, 0.0, 1.0);
}

}  // namespace omnimapper::signs
