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
  const auto now = source_tree::lines(outputOf("'" OMNIMAPPER_BIN_DIR "/omnimapper-graphslam' --ini-reference"));
  const auto kept = source_tree::lines(source_tree::read(omnimapper::testing::sourceFile("ini/README.md")));
  ASSERT_FALSE(now.empty()) << "omnimapper-graphslam --ini-reference printed nothing";
  for (std::size_t i = 0; i < std::max(now.size(), kept.size()); ++i) {
    ASSERT_EQ(i < kept.size() ? kept[i] : "(the end)", i < now.size() ? now[i] : "(the end)")
        << "ini/README.md:" << i + 1 << ": options changed: run scripts/ini-reference";
  }
}

}  // namespace
