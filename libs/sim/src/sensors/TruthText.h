#pragma once

#include <omnimapper/sim/LaserOptics.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Run lengths of a list of surface numbers: [[surface + 1, count], ...]; 0 is no surface.
nlohmann::ordered_json runLengths(const std::vector<int>& surfaces);

/// The truth of a list of echoes: surfaces; indices of those that met a surface and are not valid (missed), of mixed
/// and of mirrored ones.
nlohmann::ordered_json truthOf(const std::vector<Echo>& echoes);

/// A value rounded to the micrometre or microradian, because truth files are text.
double rounded(double value);

}  // namespace omnimapper::sim
