#pragma once

#include <CLI/CLI.hpp>

namespace omnimapper::program {

/// Says on standard error of each argument that `app` does not know what was probably meant by it.
void sayUnknown(const CLI::App& app);

/// If `app` has several tasks and the command line names none of them: says on standard error which there are, and
/// which was probably meant. Returns whether that was so.
bool saidTasks(const CLI::App& app);

}  // namespace omnimapper::program
