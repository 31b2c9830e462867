#pragma once

#include <omnimapper/sim/SimulationRun.h>

#include <string>

namespace omnimapper::sim {

/// README.md of a run's folder, which describes its files and lists the sensors.
std::string folderReadme(const Simulation& simulation, const std::string& name, const SimulationResult& result);

/// The name of the run in the first line of such a page; empty if the line is not one.
std::string nameInTitle(const std::string& line);

}  // namespace omnimapper::sim
