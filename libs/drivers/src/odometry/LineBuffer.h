#pragma once

#include <string>
#include <string_view>

namespace omnimapper::drivers {

/// Cuts a stream of bytes into lines; keeps one unfinished line of at most 256 bytes.
class LineBuffer {
 public:
  static constexpr std::size_t kLongest = 256;

  /// Calls take(line) for each line that ends in `bytes`, without its line feed and a carriage return before that, and
  /// tooLong() once for each line of more than 256 bytes.
  template <class Take, class TooLong>
  void add(std::string_view bytes, const Take& take, const TooLong& tooLong) {
    while (!bytes.empty()) {
      const auto end = bytes.find('\n');
      const auto piece = bytes.substr(0, end);
      if (!skips_ && line_.size() + piece.size() > kLongest) {
        skips_ = true;
        line_.clear();
        tooLong();
      }
      if (!skips_) line_.append(piece);
      if (end == std::string_view::npos) return;
      if (!skips_) finish(take);
      clear();
      bytes.remove_prefix(end + 1);
    }
  }

  /// Whether there are bytes after the last end of a line.
  bool isInLine() const { return skips_ || !line_.empty(); }
  void clear() {
    line_.clear();
    skips_ = false;
  }

 private:
  template <class Take>
  void finish(const Take& take) {
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    take(std::string_view(line_));
  }

  std::string line_;
  bool skips_ = false;  // skips the rest of a line that is too long
};

}  // namespace omnimapper::drivers
