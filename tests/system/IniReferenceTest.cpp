// ini/README.md and ini/simulator.md agree with the option tables.
#include <gtest/gtest.h>

#include "CommandOutput.h"
#include "SourceTree.h"

namespace {

using command_output::outputOf;

void expectReference(const std::string& file, const std::string& program) {
  const auto now = source_tree::lines(outputOf("'" OMNIMAPPER_BIN_DIR "/" + program + "' --ini-reference"));
  const auto kept = source_tree::lines(source_tree::read(omnimapper::testing::sourceFile(file)));
  ASSERT_FALSE(now.empty()) << program << " --ini-reference printed nothing";
  for (std::size_t i = 0; i < std::max(now.size(), kept.size()); ++i) {
    ASSERT_EQ(i < kept.size() ? kept[i] : "(the end)", i < now.size() ? now[i] : "(the end)")
        << file << ":" << i + 1 << ": options changed: run scripts/ini-reference";
  }
}

TEST(IniReference, isWhatTheOptionTablesSay) {
#ifdef OMNIMAPPER_LACKS_FEATURES
  GTEST_SKIP() << "a feature is not in this build, but the reference has the keys of all features";
#endif
  expectReference("ini/README.md", "omnimapper-graphslam");
  expectReference("ini/simulator.md", "omnimapper-simulate");
}

}  // namespace
