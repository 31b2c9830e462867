#pragma once

#include <omnimapper/sim/SimulationRun.h>

#include <string>

namespace omnimapper::sim {

/// README.md of a run's folder: what is what, and which sensor has which label.
std::string folderReadme(const Simulation& simulation, const std::string& name, const SimulationResult& result);

}  // namespace omnimapper::sim
