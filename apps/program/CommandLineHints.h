#pragma once

#include <CLI/CLI.hpp>

namespace omnimapper::program {

/// Says on standard error which options were probably meant by those that `app` does not know.
void sayNearest(const CLI::App& app);

/// Says on standard error which tasks `app` has, if it has several and the command line names none.
void sayTasks(const CLI::App& app);

}  // namespace omnimapper::program
