#include <omnimapper/base/Progress.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::base {

TerminalProgress::~TerminalProgress() {
  if (shown_) out_ << "\r\033[K" << std::flush;
}

void TerminalProgress::report(double fraction, const std::string& what) {
  using namespace std::chrono_literals;
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - start_ < 2s || (shown_ && now - last_ < 100ms)) return;
  last_ = now;
  shown_ = true;
  const int percent = static_cast<int>(std::lround(100 * std::clamp(fraction, 0.0, 1.0)));
  out_ << "\r\033[K" << std::string(percent / 4, '=') << std::string(25 - percent / 4, ' ') << " " << percent << " %  "
       << what << std::flush;
}

}  // namespace omnimapper::base
