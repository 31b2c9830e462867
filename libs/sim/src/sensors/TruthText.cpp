#include "TruthText.h"

#include <cmath>

namespace omnimapper::sim {

nlohmann::ordered_json runLengths(const std::vector<int>& surfaces) {
  auto runs = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < surfaces.size();) {
    std::size_t end = i;
    while (end < surfaces.size() && surfaces[end] == surfaces[i]) ++end;
    runs.push_back({surfaces[i] + 1, end - i});
    i = end;
  }
  return runs;
}

nlohmann::ordered_json truthOf(const std::vector<Echo>& echoes) {
  std::vector<int> surfaces;
  auto missed = nlohmann::ordered_json::array(), mixed = missed, mirrored = missed;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    surfaces.push_back(echoes[i].surface);
    if (!echoes[i].is_valid && echoes[i].surface >= 0) missed.push_back(i);
    if (echoes[i].is_valid && echoes[i].is_mixed) mixed.push_back(i);
    if (echoes[i].is_valid && echoes[i].is_mirrored) mirrored.push_back(i);
  }
  nlohmann::ordered_json truth;
  truth["surfaces"] = runLengths(surfaces);
  if (!missed.empty()) truth["missed"] = missed;
  truth["mixed"] = mixed;
  truth["mirrored"] = mirrored;
  return truth;
}

double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

}  // namespace omnimapper::sim
