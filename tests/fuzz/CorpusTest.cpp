// Runs the targets on the inputs that fuzzers kept, including those that once revealed a defect.
#include <gtest/gtest.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "Targets.h"

namespace omnimapper::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> corpusOf(const std::string& target) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(testing::sourceFile("tests/fuzz/corpus/" + target)))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Corpus, EachInputIsWorkedThroughOrRefused) {
  for (const auto& [name, run] : targets()) {
    const auto files = corpusOf(name);
    EXPECT_GT(files.size(), 5U) << name;
    for (const fs::path& file : files) {
      const auto bytes = bytesOf(file);
      EXPECT_NO_THROW(run(bytes.data(), bytes.size())) << file;
    }
  }
}

TEST(Corpus, EachInputMayEndAnywhere) {
  for (const auto& [name, run] : targets()) {
    EXPECT_NO_THROW(run(nullptr, 0)) << name;
    for (const fs::path& file : corpusOf(name)) {
      const auto bytes = bytesOf(file);
      for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 3)
        EXPECT_NO_THROW(run(bytes.data(), size)) << file << " up to " << size;
    }
  }
}

TEST(Corpus, IsSmall) {
  for (const auto& [name, run] : targets()) {
    std::uintmax_t size = 0;
    for (const fs::path& file : corpusOf(name)) size += fs::file_size(file);
    EXPECT_LT(size, 20000U) << name;
  }
}

}  // namespace
}  // namespace omnimapper::fuzz
