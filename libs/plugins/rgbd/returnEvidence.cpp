#include "returnEvidence.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace omnimapper::plugins {

namespace {

// Time since `begin` that lies in any of the loops [s].
double secondsIn(std::vector<Loop> loops, base::Stamp begin) {
  std::sort(loops.begin(), loops.end());
  double seconds = 0;
  auto until = begin;
  for (const auto& [seen, seen_again] : loops) {
    if (seen_again <= until) continue;
    seconds += base::secondsBetween(std::max(seen, until), seen_again);
    until = seen_again;
  }
  return seconds;
}

}  // namespace

std::vector<mapper::Evidence> returnEvidence(std::vector<Loop> loops, base::Stamp begin, base::Stamp end) {
  using Says = mapper::Evidence::Says;
  constexpr double kEnough = 25;  // [%]
  const std::size_t returns = loops.size();
  const double all = base::secondsBetween(begin, end);
  const double percent = all > 0 ? 100 * secondsIn(std::move(loops), begin) / all : 0;
  const bool is_enough = percent >= kEnough;
  char text[250] = "the camera never returned to an earlier view, which would reveal drift";
  if (returns > 0) {
    std::snprintf(
        text, sizeof text,
        "the camera returned to old views (%s) and the images fit them%s %.0f %% of the time lies between two "
        "views of one place%s",
        base::counted(returns, "time").c_str(), is_enough ? ";" : ", but only", percent,
        is_enough ? "" : ", where drift would show");
  }
  return {{"camera_returns", static_cast<double>(returns), returns > 0 ? Says::good : Says::too_little,
           is_enough ? text : ""},
          {"camera_returned_percent", percent, is_enough ? Says::good : Says::too_little, is_enough ? "" : text}};
}

}  // namespace omnimapper::plugins
