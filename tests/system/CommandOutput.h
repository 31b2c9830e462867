#pragma once

#include <stdio.h>

#include <memory>
#include <string>

namespace command_output {

/// The standard output of a shell command.
inline std::string outputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string output(1 << 16, '\0'), all;
  while (const std::size_t count = ::fread(output.data(), 1, output.size(), pipe.get())) all.append(output, 0, count);
  return all;
}

}  // namespace command_output
