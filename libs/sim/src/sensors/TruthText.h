#pragma once

#include <omnimapper/sim/LaserOptics.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// [[surface + 1, count], ...] over a list of surfaces; 0 is none.
nlohmann::ordered_json runLengths(const std::vector<int>& surfaces);

/// The truth of a list of echoes: surfaces; indices of those that met a surface and are not valid (missed), of mixed
/// and of mirrored ones.
nlohmann::ordered_json truthOf(const std::vector<Echo>& echoes);

/// Rounded to the micrometre or microradian: truth files are text.
double rounded(double value);

}  // namespace omnimapper::sim
