#pragma once

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/ChildProgram.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace omnimapper::source {

/// Runs omnimapper-import; output_ is its output.
class ImportApp : public ::testing::Test {
 protected:
  using ExitCode = base::ExitCode;
  ExitCode run(const std::string& arguments) {
    return runCommand("'" + testing::ownProgram("omnimapper-import") + "' " + arguments);
  }
  ExitCode runCommand(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    output_.clear();
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output_.append(buffer, n);
    return static_cast<ExitCode>(WEXITSTATUS(::pclose(pipe)));
  }
  bool says(const std::string& text) const { return output_.find(text) != std::string::npos; }

  std::string output_;
};

}  // namespace omnimapper::source
