// ini/README.md is what the option tables say.
#include <gtest/gtest.h>
#include <stdio.h>

#include <memory>

#include "SourceTree.h"

namespace {

/// What a shell command prints.
std::string outputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string output(1 << 16, '\0'), all;
  while (const std::size_t count = ::fread(output.data(), 1, output.size(), pipe.get())) all.append(output, 0, count);
  return all;
}

TEST(IniReference, isWhatTheOptionTablesSay) {
  const std::string now = outputOf("'" OMNIMAPPER_BIN_DIR "/omnimapper-graphslam' --ini-reference");
  ASSERT_FALSE(now.empty()) << "omnimapper-graphslam --ini-reference printed nothing";
  EXPECT_EQ(source_tree::read(omnimapper::testing::sourceFile("ini/README.md")), now)
      << "options changed: run scripts/ini-reference";
}

}  // namespace
