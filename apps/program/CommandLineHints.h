#pragma once

#include <CLI/CLI.hpp>

namespace omnimapper::program {

/// Prints on standard error, for arguments that `app` does not know, what the user probably meant.
void sayUnknown(const CLI::App& app);

/// For an `app` with several tasks: if the command line names none of them, prints on standard error the names of the
/// tasks and which one was probably meant, and returns true. Otherwise returns false.
bool saidTasks(const CLI::App& app);

}  // namespace omnimapper::program
