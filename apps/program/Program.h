#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::program {

/// Parses the command line into `app`, whose name is that of the program, and runs `body`; also handles --version.
/// Returns the exit code of `body`. An error that stops the program is printed on standard error, and its exit code is
/// returned (doc/exit_codes.md).
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// Takes the name of each required argument and whether it was given. Throws Error(command_line) naming those that were
/// not given.
void require(const std::vector<std::pair<std::string, bool>>& arguments);

/// Validators for finite numbers. (CLI11's own validators accept "nan".)
CLI::Validator notNegative();
CLI::Validator positive();

/// After this call the first Ctrl-C or SIGTERM only makes isInterrupted() true, so that a run can finish its files, and
/// the second one ends the program at once. A write beyond the limit of file size (ulimit -f) then fails as on a full
/// disk, instead of ending the program.
void listenForInterrupts();
bool isInterrupted();
/// From now on SIGUSR1 asks the program to read its settings again.
void listenForRereads();
/// Whether it was asked for since the last call.
bool takeReread();
/// To be called when all outputs are written. After this call the first Ctrl-C no longer prints that work is
/// interrupted.
void nothingIsLeftToDo();

}  // namespace omnimapper::program
