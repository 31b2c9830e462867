#include "SignEvidence.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "SignPayload.h"

namespace omnimapper::plugins {

namespace {

using Visits = std::vector<std::pair<base::Stamp, base::Stamp>>;  // of one sign: first, again

// Of a time, what lies in any of them.
double percentIn(Visits visits, base::Stamp begin, base::Stamp end) {
  const double all = base::secondsBetween(begin, end);
  if (!(all > 0)) return 0;
  std::sort(visits.begin(), visits.end());
  double seconds = 0;
  auto until = begin;
  for (const auto& [first, again] : visits) {
    if (again <= until) continue;
    seconds += base::secondsBetween(std::max(first, until), again);
    until = again;
  }
  return 100 * seconds / all;
}

}  // namespace

std::vector<mapper::Evidence> signEvidence(const mapper::View& view, const std::string& section) {
  using Says = mapper::Evidence::Says;
  constexpr double kEnough = 25;  // [%]
  constexpr std::size_t kSome = 2;
  std::map<std::string, std::size_t> places;  // active signs, by number
  Visits visits;
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto* sign = dynamic_cast<const SignPayload*>(landmark.payload.get());
    if (!sign || landmark.owner != section) continue;
    const SignText text = sign->text();
    if (!isOfOneSign(text)) continue;
    if (landmark.state == map::Landmark::State::active) ++places[text.number];
    if (landmark.state != map::Landmark::State::merged) continue;
    const auto& first = view.map.landmark(id).first_seen;
    visits.emplace_back(std::min(first, landmark.first_seen), std::max(first, landmark.first_seen));
  }
  std::size_t elsewhere = 0;
  for (const auto& [number, count] : places) elsewhere += count - 1;
  if (visits.empty() && elsewhere < kSome) return {};
  char text[200] = "";
  if (elsewhere >= kSome && elsewhere > visits.size()) {
    std::snprintf(text, sizeof text,
                  "of the numbers on signs that were read again %zu stand at another place than before and %zu at the "
                  "same: the map is bent, or doors have one number",
                  elsewhere, visits.size());
    return {{"sign_numbers_elsewhere", static_cast<double>(elsewhere), Says::against_it, text}};
  }
  const auto& frames = view.map.key_frames;
  const double percent = percentIn(visits, frames.front().stamp, frames.back().stamp);
  const bool is_enough = percent >= kEnough;
  std::snprintf(text, sizeof text,
                "numbers on signs were read again at the same place %s%s %.0f %% of the time lies between%s",
                base::counted(visits.size(), "time").c_str(), is_enough ? ";" : ", but only", percent,
                is_enough ? "" : ", and they confirm nothing of the rest");
  return {{"sign_numbers_elsewhere", static_cast<double>(elsewhere), Says::good, ""},
          {"way_between_visits_percent", percent, is_enough ? Says::good : Says::too_little, text}};
}

}  // namespace omnimapper::plugins
