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

/// Adds a subcommand for each kind of log. Returns what does the import that the parsed command line asks for.
std::function<omnimapper::base::ExitCode()> addKinds(CLI::App& app, Arguments& arguments);
