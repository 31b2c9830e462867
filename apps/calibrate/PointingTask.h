#pragma once

#include <omnimapper/calibration/PointingRun.h>

#include <CLI/CLI.hpp>
#include <string>

struct PointingArguments {
  omnimapper::calibration::PointingRequest request;
  std::string unit = "recognised", axes = "recognised";
  bool quiet = false;
};

/// Adds the task `pointing` with its options to the program.
CLI::App* addPointingTask(CLI::App& app, PointingArguments& arguments);
/// Measures how far people miss what they point at, writes and prints it. Returns the exit code.
int runPointingTask(PointingArguments arguments);
