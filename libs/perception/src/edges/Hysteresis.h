#pragma once

#include <cstdint>
#include <vector>

namespace omnimapper::perception::edges {

/// Edge candidates of an image: the state of each pixel, with a border of one pixel of kNothing around the image.
class Candidates {
 public:
  enum : std::uint8_t { kNothing = 0, kWeak = 1, kStrong = 2, kKept = 3 };

  Candidates(int width, int height)
      : stride_(width + 2),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2), kNothing) {}

  std::uint8_t* row(int y) { return values_.data() + static_cast<std::ptrdiff_t>(y + 1) * stride_ + 1; }
  void addStrong(int x, int y) {
    row(y)[x] = kStrong;
    strong_.push_back(static_cast<int>(static_cast<std::ptrdiff_t>(y + 1) * stride_ + x + 1));
  }

  /// Sets strong pixels, and weak ones that are 8-connected with them, to kKept if their component has at least
  /// `fewest` pixels; else to kNothing.
  void keepConnected(int fewest);

 private:
  int stride_;
  std::vector<std::uint8_t> values_;
  std::vector<int> strong_;
};

}  // namespace omnimapper::perception::edges
