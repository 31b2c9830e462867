#pragma once

#include <omnimapper/sim/SimulationRun.h>

#include <string>

namespace omnimapper::sim {

/// README.md of a run's folder: what is what, and which sensor has which label.
std::string folderReadme(const Simulation& simulation, const std::string& name, const SimulationResult& result);

/// The name in the first line of such a page; empty if the line is of no such page.
std::string nameInTitle(const std::string& line);

}  // namespace omnimapper::sim
