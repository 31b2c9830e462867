#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

struct MountingArguments {
  std::vector<std::string> logs, inis;
  std::string output;
  bool quiet = false;
};

/// Adds the task `mounting` with its options to the program.
CLI::App* addMountingTask(CLI::App& app, MountingArguments& arguments);
/// Measures, writes and prints how sensors are mounted. Returns the exit code.
int runMountingTask(const MountingArguments& arguments);
