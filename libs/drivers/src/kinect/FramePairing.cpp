#include <omnimapper/drivers/FramePairing.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::drivers {

void FramePairing::addPicture(double seconds, std::vector<std::uint8_t> picture) {
  constexpr std::size_t kMost = 4;
  pictures_.push_back({seconds, std::move(picture)});
  if (pictures_.size() > kMost) pictures_.pop_front();
}

std::optional<KinectFrame> FramePairing::take(bool at_once) {
  if (depths_.empty()) return std::nullopt;
  const double when = depths_.front().seconds;
  const bool is_late = depths_.back().seconds - when > largest_difference_;
  const bool has_later_picture = !pictures_.empty() && pictures_.back().seconds >= when;
  if (!at_once && !is_late && !has_later_picture) return std::nullopt;
  KinectFrame frame = std::move(depths_.front());
  depths_.pop_front();
  const auto distance = [&](const Picture& picture) { return std::abs(picture.seconds - when); };
  const auto nearest = std::min_element(pictures_.begin(), pictures_.end(),
                                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest != pictures_.end() && distance(*nearest) <= largest_difference_) {
    frame.picture = std::move(nearest->pixels);
    pictures_.erase(pictures_.begin(), nearest + 1);
  }
  return frame;
}

}  // namespace omnimapper::drivers
