#include "SignEvidence.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "SignPayload.h"

namespace omnimapper::plugins {

namespace {

// The distance travelled until each key frame [m]. Gaps between sessions do not count.
class Travel {
 public:
  explicit Travel(const map::KeyFrames& frames) : frames_(frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const bool goes_on = i > 0 && frames[i].id.session == frames[i - 1].id.session;
      const double step = goes_on ? frames[i].map_from_base.distanceTo(frames[i - 1].map_from_base) : 0;
      until_.push_back((i > 0 ? until_.back() : 0) + step);
    }
  }
  double all() const { return until_.empty() ? 0 : until_.back(); }
  double at(std::uint16_t session, base::Stamp stamp) const {
    return until_[std::min(frames_.lowerBound(session, stamp), until_.size() - 1)];
  }

 private:
  const map::KeyFrames& frames_;
  std::vector<double> until_;
};

using Visits = std::vector<std::pair<double, double>>;  // [m] of the distance travelled: first, again

double metresIn(Visits visits) {
  std::sort(visits.begin(), visits.end());
  double metres = 0, until = 0;
  for (const auto& [first, again] : visits) {
    metres += std::max(0.0, again - std::max(first, until));
    until = std::max(until, again);
  }
  return metres;
}

// The number of signs that are farther from the first sign with their number than a position error could explain.
std::size_t elsewhereAmong(const std::map<std::string, std::vector<Eigen::Vector3d>>& places) {
  constexpr double kElsewhere = 3;  // [m]
  std::size_t elsewhere = 0;
  for (const auto& [number, points] : places)
    for (const auto& point : points) elsewhere += (point - points.front()).norm() > kElsewhere;
  return elsewhere;
}

}  // namespace

std::vector<mapper::Evidence> signEvidence(const mapper::View& view, const std::string& section, double recent_travel) {
  using Says = mapper::Evidence::Says;
  constexpr double kEnough = 25;  // [%]
  // One number elsewhere for three at the same place counts against the map; correct maps had 0 for about 15.
  constexpr std::size_t kSome = 2, kPerElsewhere = 3;
  const Travel travel(view.map.key_frames);
  std::map<std::string, std::vector<Eigen::Vector3d>> places;  // of active signs, by number
  Visits visits;
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto* sign = dynamic_cast<const SignPayload*>(landmark.payload.get());
    if (!sign || landmark.owner != section || !isOfOneSign(sign->text())) continue;
    if (landmark.state == map::Landmark::State::active)
      places[sign->text().number].emplace_back(view.graph.value(landmark.variables.front()));
    if (landmark.state != map::Landmark::State::merged) continue;
    const auto& kept = view.map.landmark(id);
    const double one = travel.at(kept.id.session, kept.first_seen), other = travel.at(id.session, landmark.first_seen);
    if (std::abs(one - other) > recent_travel) visits.push_back(std::minmax(one, other));
  }
  const std::size_t elsewhere = elsewhereAmong(places);
  if (visits.empty() && elsewhere < kSome) return {};
  char text[220] = "";
  if (elsewhere >= kSome && kPerElsewhere * elsewhere > visits.size()) {
    std::snprintf(text, sizeof text,
                  "of the numbers on signs that were read again, %zu are at another place than before and %zu at the "
                  "same: the map is distorted, or several doors have the same number",
                  elsewhere, visits.size());
    return {{"sign_numbers_elsewhere", static_cast<double>(elsewhere), Says::against_it, text}};
  }
  const double spanned = metresIn(visits), percent = travel.all() > 0 ? 100 * spanned / travel.all() : 0;
  const bool is_enough = percent >= kEnough;
  std::snprintf(text, sizeof text,
                "numbers on signs were read again at the same place %s%s %.0f m of the %.0f m driven lie between two "
                "readings of a sign%s",
                base::counted(visits.size(), "time").c_str(), is_enough ? ", and" : ", but only", spanned, travel.all(),
                is_enough ? "" : ", and nothing confirms the rest");
  return {{"sign_numbers_elsewhere", static_cast<double>(elsewhere), Says::good, ""},
          {"travel_between_visits_percent", percent, is_enough ? Says::good : Says::too_little, text}};
}

}  // namespace omnimapper::plugins
