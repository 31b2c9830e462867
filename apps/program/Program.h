#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::program {

/// Parses the command line into `app`, whose name is the program's, and runs `body`; --version is understood, too.
/// Returns the exit code: that of `body`, or that of the error that stopped it, which is then told on standard error
/// (doc/exit_codes.md).
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// Throws Error(command_line) that names the arguments which are needed and were not given.
void require(const std::vector<std::pair<std::string, bool>>& arguments);

/// Validators of numbers, which must be finite: CLI11's own let "nan" pass.
CLI::Validator notNegative();
CLI::Validator positive();

/// From now on Ctrl-C and SIGTERM only make isInterrupted() true, a second of them ends the program at once, and a file
/// at the limit of its size fails as on a full disk: a run can end its files properly.
void listenForInterrupts();
bool isInterrupted();
/// From now on an interrupt finds everything written, and is no longer answered as one that cuts something short.
void nothingIsLeftToDo();

}  // namespace omnimapper::program
