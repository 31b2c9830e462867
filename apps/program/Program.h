#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::program {

/// Parses the command line into `app`, which has the name of the program, and runs `body`; also handles --version.
/// Returns the exit code of `body`, or of the error that stopped it, which is then printed on standard error
/// (doc/exit_codes.md).
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// Throws Error(command_line) naming the required arguments that were not given.
void require(const std::vector<std::pair<std::string, bool>>& arguments);

/// Validators for finite numbers: CLI11's own ones accept "nan".
CLI::Validator notNegative();
CLI::Validator positive();

/// After this call the first Ctrl-C or SIGTERM only makes isInterrupted() true, the second ends the program at once,
/// and reaching the limit of file size fails like a full disk, so that a run can finish its files properly.
void listenForInterrupts();
bool isInterrupted();
/// After this call everything is written, and an interrupt is not announced as one that stops work.
void nothingIsLeftToDo();

}  // namespace omnimapper::program
