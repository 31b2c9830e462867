#pragma once

#include <omnimapper/net/Network.h>

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "Corners.h"

namespace omnimapper::signs {

/// A line of text in a picture.
struct TextLine {
  Corners quad;      ///< [px] around it, with a little of what is about it
  double score = 0;  ///< how sure the detector is that this is text, 0 to 1
};

/// Finds lines of text by a network that says of each pixel how likely it is in the core of a line (DB: Liao, Wan, Yao
/// et al., Real-time scene text detection with differentiable binarization, 2020), as those of PaddleOCR do.
/// Thread-safe; the same picture gives the same bits on one kind of processor.
class TextDetector {
 public:
  /// Height and width of what the network takes, (1, 3, rows, columns), and its answer, (1, 1, rows, columns).
  static constexpr int kRows = 480, kColumns = 736;

  /// Throws Error(unreadable_input) with the network's file if it takes or gives other shapes.
  explicit TextDetector(std::shared_ptr<const net::Network> network);

  /// Lines from top to bottom. `picture` is of 8 bits, BGR; a larger one is made smaller until it fits the network, so
  /// letters should be 8 px tall then.
  std::vector<TextLine> detect(const cv::Mat& picture) const;

 private:
  std::shared_ptr<const net::Network> network_;
};

}  // namespace omnimapper::signs
