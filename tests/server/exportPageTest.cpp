#include "../query/MapWithFrames.h"
#include "bundled.h"
#include "omnimapper/server/exportPage.h"

namespace omnimapper::server::export_page_test {
namespace {

using ExportPage = query::MapWithFrames;

std::string read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Bundled, ModulesBecomeOneScriptInTheOrderInWhichTheyAreNeeded) {
  const std::map<std::string, std::string> modules{
      {"app.js", "import { twice } from './math.js';\nimport * as all from './math.js';\ntwice(all.one);\n"},
      {"math.js", "const hidden = 2;\nexport const one = 1;\nexport function twice(x) {\n  return hidden * x;\n}\n"},
      {"unused.js", "never();\n"}};
  EXPECT_EQ(
      bundled(modules, "app.js"),
      "'use strict';\n(() => {\nconst modules = {};\n"
      "modules['math.js'] = (() => {\nconst hidden = 2;\nconst one = 1;\nfunction twice(x) {\n  return hidden * x;\n}\n"
      "return { one, twice };\n})();\n"
      "modules['app.js'] = (() => {\nconst { twice } = modules['math.js'];\nconst all = modules['math.js'];\n"
      "twice(all.one);\nreturn { };\n})();\n})();\n");
  EXPECT_THROW(bundled(modules, "missing.js"), base::Error);
  EXPECT_THROW(bundled({{"a.js", "import { b } from './b.js';\n"}, {"b.js", "import { a } from './a.js';\n"}}, "a.js"),
               base::Error);
}

TEST_F(ExportPage, TheFolderHasThePageAndTheMapAndNoPathOfThisMachine) {
  write();
  std::filesystem::create_directory(folder_ / "objects");
  query::putFile(folder_ / "objects/0-1.png", "a picture");
  const std::string out = folder_ / "out/page";
  exportPage(folder_.path(), testing::sourceFile("web"), out);
  const std::string index = read(out + "/index.html"), map = read(out + "/map.js"), script = read(out + "/page.js");
  EXPECT_EQ(index.find("module"), std::string::npos);
  EXPECT_NE(index.find("<script defer src=\"map.js\">"), std::string::npos);
  EXPECT_EQ(script.find("import "), std::string::npos) << "browsers load no modules from files";
  EXPECT_EQ(map.rfind("globalThis.omnimapperMap = {", 0), 0U);
  const auto data = nlohmann::json::parse(map.substr(map.find('{'), map.rfind('}') + 1 - map.find('{')));
  EXPECT_EQ(data["map"]["places"].size(), 6U);
  EXPECT_EQ(data["grid"].get<std::string>().rfind("data:image/png;base64,iVBOR", 0), 0U);
  EXPECT_EQ(map.find(folder_.path()), std::string::npos);
  EXPECT_EQ(data["map"]["solid"], nullptr) << "a copy has no view in 3D";
  EXPECT_EQ(read(out + "/picture-0-1.png"), "a picture");
}

TEST_F(ExportPage, ASecondCopyHasNoPictureOfWhatIsGone) {
  write();
  std::filesystem::create_directory(folder_ / "objects");
  query::putFile(folder_ / "objects/0-1.png", "a picture");
  const std::string out = folder_ / "out";
  exportPage(folder_.path(), testing::sourceFile("web"), out);
  query::putFile(out + "/picture-of-my-cat.png", "a cat");
  std::filesystem::remove(folder_ / "objects/0-1.png");
  exportPage(folder_.path(), testing::sourceFile("web"), out);
  EXPECT_FALSE(std::filesystem::exists(out + "/picture-0-1.png"));
  EXPECT_EQ(read(out + "/picture-of-my-cat.png"), "a cat") << "it is not of a copy";
}

TEST_F(ExportPage, ThePageThatComesWithTheProgramIsNotOverwritten) {
  write();
  const std::string page = folder_ / "web";
  std::filesystem::copy(testing::sourceFile("web"), page);
  std::filesystem::create_directory_symlink(page, folder_ / "link");
  EXPECT_NE(query::refusalOf([&] { exportPage(folder_.path(), page, folder_ / "link"); }, base::ExitCode::command_line),
            "");
  EXPECT_EQ(read(page + "/index.html"), read(testing::sourceFile("web/index.html")));
}

TEST_F(ExportPage, TheFolderOfTheMapIsNotWrittenInto) {
  write();
  EXPECT_NE(query::refusalOf([&] { exportPage(folder_.path(), testing::sourceFile("web"), folder_.path()); },
                             base::ExitCode::command_line),
            "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "index.html"));
}

}  // namespace
}  // namespace omnimapper::server::export_page_test
