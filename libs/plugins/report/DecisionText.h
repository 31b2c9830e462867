#pragma once

#include <omnimapper/plugin/DecisionLog.h>

#include <string>

namespace omnimapper::plugins {

/// "accepted", or "refused: too little overlap".
std::string verdictText(const mapper::Decision& decision);
/// "overlap 0.82, mean distance 0.021 m": units in brackets move behind the values.
std::string numbersText(const mapper::Decision& decision);

}  // namespace omnimapper::plugins
