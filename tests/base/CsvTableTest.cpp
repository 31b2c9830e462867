#include <gtest/gtest.h>
#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>

namespace omnimapper::base::csv_table_test {
namespace {

std::string written(const testing::ScratchFolder& folder, const std::string& text) {
  const std::string path = folder / "table.csv";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

TEST(CsvTable, fieldsComeBackAsTheyWereWritten) {
  const testing::ScratchFolder folder;
  const std::string names[] = {"plain", "with, comma", "with \"quotes\"", "\"", "", ","};
  std::string text = "name,number\n";
  for (const std::string& name : names) text += csvField(name) + ",2.5\r\n";
  const CsvTable table(written(folder, text));
  ASSERT_EQ(table.size(), std::size(names));
  for (std::size_t row = 0; row < table.size(); ++row) {
    EXPECT_EQ(table.text(row, "name"), names[row]);
    EXPECT_EQ(table.number(row, "number"), 2.5);
  }
  EXPECT_EQ(csvField("plain"), "plain") << "quotes are only there where they are needed";
}

TEST(CsvTable, damagedTablesAreRefusedWithTheirLine) {
  const testing::ScratchFolder folder;
  const auto refusal = [&](const std::string& text, const std::string& column) {
    try {
      const CsvTable table(written(folder, text));
      for (std::size_t row = 0; row < table.size(); ++row) table.number(row, column);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::unreadable_input);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("a,b\n1,2\n", "b"), "");
  EXPECT_NE(refusal("", "a").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("a,a\n", "a").find("twice"), std::string::npos);
  EXPECT_NE(refusal("a,b\n1,2\n1\n", "a").find(":3: 1 fields"), std::string::npos);
  EXPECT_NE(refusal("a,b\n1,x\n", "b").find(":2: column b"), std::string::npos);
  EXPECT_NE(refusal("a,b\n1,nan\n", "b").find("no number"), std::string::npos);
  EXPECT_NE(refusal("a\n1\n", "b").find("no column 'b'"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::base::csv_table_test
