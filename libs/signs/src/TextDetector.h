#pragma once

#include <omnimapper/net/Network.h>

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// A line of text in a picture.
struct TextLine {
  Corners quad;      ///< [px] box of the line, with a small margin
  double score = 0;  ///< how sure the detector is that this is text, 0 to 1
};

/// Finds lines of text with a network that gives for each pixel the probability that it is in the core of a line, as
/// those of PaddleOCR do (DB: Liao, Wan, Yao et al., Real-time scene text detection with differentiable binarization,
/// 2020). Thread-safe; the same picture gives the same bits on one kind of processor.
class TextDetector {
 public:
  /// Height and width of the network's input, whose shape is (1, 3, rows, columns), and of its output (1, 1, rows,
  /// columns).
  static constexpr int kRows = 480, kColumns = 736;

  /// Throws Error(unreadable_input), which names the network's file, if its input or output has another shape.
  explicit TextDetector(std::shared_ptr<const net::Network> network);

  /// Lines from top to bottom. `picture` is of 8 bits, BGR; a larger one is scaled down to fit the network, and its
  /// letters should still be 8 px tall then.
  std::vector<TextLine> detect(const cv::Mat& picture) const;

 private:
  std::shared_ptr<const net::Network> network_;
};

}  // namespace omnimapper::signs
