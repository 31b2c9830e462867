#pragma once

#include <CLI/CLI.hpp>

namespace omnimapper::program {

/// Prints on standard error, for each argument that `app` does not know, what was probably meant by it.
void sayUnknown(const CLI::App& app);

/// If `app` has several tasks and the command line gives none of them, prints on standard error which there are and
/// which was probably meant. Returns whether that was the case.
bool saidTasks(const CLI::App& app);

}  // namespace omnimapper::program
