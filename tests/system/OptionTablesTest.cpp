#include <gtest/gtest.h>

#include <map>
#include <set>

#include "SourceTree.h"

// Every key of an INI is declared once, in an OptionTable. These rules find keys that do nothing.
namespace {

using namespace source_tree;

struct Declared {
  std::string file;
  std::string table;  // file, number of the table in it, and struct
  std::string key, member;
};

/// All keys that the option tables of the libraries declare.
std::vector<Declared> declaredKeys() {
  static const std::regex key(
      R"re(\.(?:number|integer|flag|text|list|choice)\(\s*"(\w+)",\s*&(?:\w+::)*(\w+)::(\w+))re");
  static const std::string table = "OptionTable<";
  std::vector<Declared> all;
  for (const auto& file : files("libs", {".cpp", ".h"})) {
    const std::string text = read(file);
    std::size_t tables = 0, next = text.find(table);
    for (std::sregex_iterator at(text.begin(), text.end(), key), end; at != end; ++at) {
      for (; next < static_cast<std::size_t>(at->position()); next = text.find(table, next + 1)) ++tables;
      const std::string name = projectPath(file);
      all.push_back({name, name + " " + std::to_string(tables) + " " + (*at)[2].str(), (*at)[1], (*at)[3]});
    }
  }
  return all;
}

TEST(OptionTables, declareEachKeyAndEachMemberOnce) {
  std::set<std::string> keys, members;
  const auto all = declaredKeys();
  EXPECT_GT(all.size(), 500U);
  for (const auto& each : all) {
    EXPECT_TRUE(keys.insert(each.table + " " + each.key).second)
        << each.file << " declares the key " << each.key << " twice";
    EXPECT_TRUE(members.insert(each.table + " " + each.member).second)
        << each.file << ": two keys set the member " << each.member << "; one of them is " << each.key;
  }
}

TEST(OptionTables, haveNoKeyThatNoCodeReads) {
  std::map<std::string, std::size_t> words;
  static const std::regex word(R"(\w+)");
  for (const char* folder : {"libs", "apps"}) {
    for (const auto& file : files(folder, {".cpp", ".h"})) {
      const std::string code = codeOnly(read(file));
      for (std::sregex_iterator at(code.begin(), code.end(), word), end; at != end; ++at) ++words[at->str()];
    }
  }
  std::map<std::string, std::size_t> declarations;  // of a member: in its struct, and in its table
  for (const auto& each : declaredKeys()) declarations[each.member] += 2;
  for (const auto& each : declaredKeys())
    EXPECT_GT(words[each.member], declarations[each.member])
        << each.file << ": no code reads " << each.member << ", which the key " << each.key << " sets";
}

}  // namespace
