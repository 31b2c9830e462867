#pragma once

#include <omnimapper/base/Error.h>

#include <functional>
#include <string>

#include "Imports.h"
#include "program/Program.h"

/// The command line of omnimapper-import.
struct Arguments {
  std::string input, output, odometry = "automatic", images = "embedded";
  bool poses = false;
  omnimapper::source::RgbdFolderOptions rgbd;
  omnimapper::source::PcdFolderOptions pcd;
  omnimapper::source::ImageFolderOptions photographs;
};

/// Adds a subcommand for each kind of log. Returns a function that runs the import selected on the command line.
std::function<omnimapper::base::ExitCode()> addKinds(CLI::App& app, Arguments& arguments);
