#include <omnimapper/base/Progress.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::base {

TerminalProgress::~TerminalProgress() {
  if (shown_) out_ << "\r\033[K" << std::flush;
}

bool TerminalProgress::isDue() {
  using namespace std::chrono_literals;
  if (!terminal_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - start_ < 2s || (shown_ && now - last_ < 100ms)) return false;
  last_ = now;
  shown_ = true;
  return true;
}

void TerminalProgress::report(double fraction, const std::string& what) {
  if (!isDue()) return;
  const int percent = static_cast<int>(std::lround(100 * std::clamp(fraction, 0.0, 1.0)));
  out_ << "\r\033[K" << std::string(percent / 4, '=') << std::string(25 - percent / 4, ' ') << " " << percent << " %  "
       << what << std::flush;
}

void TerminalProgress::reportState(const std::string& how) {
  if (isDue()) out_ << "\r\033[K" << how << std::flush;
}

void TerminalProgress::reportEvent(const std::string& sentence) {
  if (!quiet_) out_ << (shown_ ? "\r\033[K" : "") << sentence << "\n" << std::flush;
}

}  // namespace omnimapper::base
