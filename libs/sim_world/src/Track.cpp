#include <omnimapper/sim_world/Track.h>

#include <algorithm>
#include <stdexcept>

namespace omnimapper::sim {

Track::Track(Kind kind, std::vector<Place> places) : kind_(kind), places_(std::move(places)) {
  if (places_.empty()) throw std::invalid_argument("Track: no place");
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (i > 0 && !(places_[i - 1].time < places_[i].time)) throw std::invalid_argument("Track: times must increase");
    if (kind == Kind::motion && !places_[i].map_from_body) throw std::invalid_argument("Track: a motion needs poses");
  }
}

std::optional<geometry::Se3> Track::at(double time) const {
  const auto after = std::upper_bound(places_.begin(), places_.end(), time,
                                      [](double t, const Place& place) { return t < place.time; });
  if (after == places_.begin()) return after->map_from_body;
  const auto before = after - 1;
  if (kind_ == Kind::steps || after == places_.end()) return before->map_from_body;
  const geometry::Se3 &from = *before->map_from_body, &to = *after->map_from_body;
  const double share = (time - before->time) / (after->time - before->time);
  return geometry::plus(from, share * geometry::minus(to, from));
}

}  // namespace omnimapper::sim
