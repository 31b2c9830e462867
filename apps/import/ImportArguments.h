#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

/// The command line of omnimapper-import: a task for each registered format, with the format's options.
struct Arguments {
  std::string input, output, images = "embedded";
  bool poses = false;
  /// The task, and the values of its options by key, which are empty if they were not given.
  struct Format {
    std::string name;
    const CLI::App* task;
    std::vector<std::pair<std::string, std::string>> values;
  };
  std::vector<std::unique_ptr<Format>> formats;

  const Format& chosen() const;
};

void addFormats(CLI::App& app, Arguments& arguments);
