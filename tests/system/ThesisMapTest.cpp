// doc/thesis_map.md has one row for every section of chapters 3 to 6 of the thesis, and the files that it names exist.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "SourceTree.h"

namespace {

/// Number of subsections of every section that has any, by its number; "3" is chapter 3 itself.
const std::map<std::string, int> subsections{
    {"3", 5},     {"3.1", 4},   {"3.3", 1},   {"3.4", 9},   {"3.4.2", 1}, {"3.4.9", 5}, {"3.5", 3},   {"3.5.1", 2},
    {"3.5.3", 3}, {"4", 6},     {"4.1", 2},   {"4.2", 4},   {"4.2.2", 3}, {"4.3", 2},   {"4.3.2", 5}, {"4.4", 2},
    {"4.4.1", 2}, {"4.5", 2},   {"4.5.2", 5}, {"4.6", 4},   {"4.6.2", 3}, {"4.6.3", 4}, {"5", 6},     {"5.2", 3},
    {"5.2.2", 3}, {"5.2.3", 3}, {"5.3", 6},   {"5.3.2", 1}, {"5.3.3", 4}, {"5.3.4", 3}, {"5.3.5", 2}, {"5.4", 4},
    {"5.5", 4},   {"5.5.2", 2}, {"5.5.4", 4}, {"6", 3},     {"6.1", 8},   {"6.1.2", 2}, {"6.1.5", 3}, {"6.1.6", 2},
    {"6.1.7", 2}, {"6.2", 9},   {"6.2.2", 1}, {"6.2.7", 3}, {"6.3", 5},   {"6.3.3", 3},
};

struct Row {
  std::string section, title, where, state, in_thesis, here;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<Row> rows() {
  std::vector<Row> all;
  const std::regex number(R"(\d+(\.\d+)+)");
  for (const std::string& line :
       source_tree::lines(source_tree::read(omnimapper::testing::sourceFile("doc/thesis_map.md")))) {
    std::vector<std::string> cells;
    std::istringstream in(line.empty() ? line : line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
    if (line.empty() || line[0] != '|' || cells.empty() || !std::regex_match(cells[0], number)) continue;
    EXPECT_EQ(cells.size(), 6u) << "row " << cells[0] << " has " << cells.size() << " columns instead of 6";
    cells.resize(6);
    all.push_back({cells[0], cells[1], cells[2], cells[3], cells[4], cells[5]});
  }
  return all;
}

TEST(ThesisMap, everySectionStandsThereOnce) {
  std::map<std::string, int> found;
  for (const Row& row : rows()) ++found[row.section];
  for (const auto& [section, count] : subsections) {
    for (int i = 1; i <= count; ++i) {
      const std::string wanted = section + "." + std::to_string(i);
      EXPECT_EQ(found[wanted], 1) << "section " << wanted << " is in the map " << found[wanted] << " times";
      found.erase(wanted);
    }
  }
  for (const auto& [section, count] : found) {
    ADD_FAILURE() << "section " << section << " is in the map " << count << " times but not in the thesis";
  }
}

TEST(ThesisMap, statesAreKnownAndPartlyNamesWhatIsMissing) {
  const std::set<std::string> known{"done", "partly", "not yet", "text only"};
  for (const Row& row : rows()) {
    EXPECT_EQ(known.count(row.state), 1u)
        << "section " << row.section << " has the unknown state '" << row.state << "'";
    if (row.state == "partly") {
      EXPECT_FALSE(row.here.empty()) << "section " << row.section << " does not say what is missing";
    }
    if (row.state == "done") {
      EXPECT_FALSE(row.where.empty()) << "section " << row.section << " does not say where it is";
    }
  }
}

TEST(ThesisMap, whatIsCalledDoneExists) {
  for (const Row& row : rows()) {
    if (row.state != "done" && row.state != "partly") continue;
    for (const std::string& place : source_tree::matches(row.where, "`([^`]+)`")) {
      EXPECT_TRUE(source_tree::fs::exists(omnimapper::testing::sourceFile(place)))
          << "section " << row.section << " is " << row.state << " in " << place << ", which does not exist";
    }
  }
}

}  // namespace
