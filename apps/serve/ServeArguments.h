#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

/// The command line of omnimapper-serve.
struct ServeArguments {
  std::string map, growing, address = "127.0.0.1", commands;
  std::vector<std::string> hosts;
  std::uint16_t port = 8080;
  bool is_read_only = false, until_end_of_input = false, quiet = false;
};

void addOptions(CLI::App& app, ServeArguments& arguments);

/// Throws Error(command_line) if other machines would reach the page at that address, or if it is none.
void refuseOtherMachines(const std::string& address);
