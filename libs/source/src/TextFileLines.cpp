#include <omnimapper/source/TextFileLines.h>

namespace omnimapper::source {

namespace {
constexpr std::size_t kReadAtOnce = 1 << 16;
constexpr std::size_t kLongest = 1 << 20;
}  // namespace

bool TextFileLines::refill() {
  buffer_.resize(kReadAtOnce);
  buffer_.resize(file_.read(buffer_.data(), kReadAtOnce));
  next_ = 0;
  return !buffer_.empty();
}

bool TextFileLines::next(std::string& line) {
  line.clear();
  is_whole_ = false;
  bool any = false;
  while (next_ < buffer_.size() || refill()) {
    any = true;
    const auto end = buffer_.find('\n', next_);
    const auto stop = end == std::string::npos ? buffer_.size() : end;
    if (line.size() < kLongest) line.append(buffer_, next_, stop - next_);
    next_ = stop;
    if (end == std::string::npos) continue;
    ++next_;
    is_whole_ = line.size() < kLongest;
    break;
  }
  if (any) ++number_;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return any;
}

}  // namespace omnimapper::source
