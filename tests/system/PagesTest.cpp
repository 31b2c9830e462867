// The pages of the project: links have a target, commands use options that exist, and names are unique and have units.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "CommandOutput.h"
#include "SourceTree.h"

namespace {

using command_output::outputOf;
using source_tree::files;
using source_tree::lines;
using source_tree::projectPath;
using source_tree::read;
using source_tree::fs::path;

std::vector<path> pages() {
  auto all = files("doc", {".md"});
  for (const char* folder : {"ini", "rawlogs", "tests", "apps", "libs"}) {
    const auto more = files(folder, {".md"});
    all.insert(all.end(), more.begin(), more.end());
  }
  for (const char* page : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "AGENTS.md"})
    all.emplace_back(omnimapper::testing::sourceFile(page));
  return all;
}

/// Only the code blocks of a page (between lines of ```), or the page without them.
std::string partOf(const std::string& page, bool code) {
  std::string part;
  bool is_code = false;
  for (const auto& line : lines(page)) {
    if (line.rfind("```", 0) == 0) {
      is_code = !is_code;
      continue;
    }
    if (is_code == code) part += line + "\n";
  }
  return part;
}

/// The anchor of a heading on GitHub: lower case, hyphens for blanks, no punctuation.
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-')
      anchor += static_cast<char>(std::tolower(c));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchorsOf(const path& page) {
  std::set<std::string> anchors;
  for (const auto& heading : source_tree::matches("\n" + partOf(read(page), false), R"(\n#+ ([^\n]*))"))
    anchors.insert(anchorOf(heading));
  return anchors;
}

TEST(Pages, everyLinkLeadsSomewhere) {
  std::size_t followed = 0;
  for (const auto& page : pages()) {
    for (const auto& link : source_tree::matches(partOf(read(page), false), R"(\]\(([^)\s]+)\))")) {
      if (std::regex_search(link, std::regex("^[a-z]+:"))) continue;
      ++followed;
      const std::string file = link.substr(0, link.find('#'));
      const path target = file.empty() ? page : page.parent_path() / file;
      ASSERT_TRUE(source_tree::fs::exists(target))
          << projectPath(page) << " links to " << link << ", which is not there";
      if (link.find('#') == std::string::npos || target.extension() != ".md") continue;
      EXPECT_EQ(anchorsOf(target).count(link.substr(link.find('#') + 1)), 1U)
          << projectPath(page) << " links to " << link << ", and no heading there has that anchor";
    }
  }
  EXPECT_GT(followed, 100U);
}

/// Options that the help of a program lists, and those of its verbs.
const std::set<std::string>& optionsOf(const std::string& program) {
  static std::map<std::string, std::set<std::string>> known;
  const auto found = known.find(program);
  if (found != known.end()) return found->second;
  const std::string command = "'" OMNIMAPPER_BIN_DIR "/" + program + "' ";
  std::string help = outputOf(command + "--help 2>/dev/null");
  const std::string before_verb = program == "omnimapper-query" ? "MAP " : "";
  for (const auto& verb : source_tree::matches("\n" + help, R"(\n  ([a-z][a-z_-]+) )"))
    help += outputOf(command + before_verb + verb + " --help 2>/dev/null");
  const auto options = source_tree::matches(" " + help, R"([^\w-](--?[A-Za-z][\w-]*))");
  return known[program] = {options.begin(), options.end()};
}

TEST(Pages, programsKnowTheOptionsOfEveryCommand) {
#ifdef OMNIMAPPER_LACKS_FEATURES
  GTEST_SKIP() << "a feature is not in this build, but the pages have the commands of all features";
#endif
  const std::regex command(
      R"((omnimapper-(?:graphslam|query|eval|import|perceive|simulate|calibrate|rooms))((?:[^\n`|;&>\\#]|\\\n)*))");
  const std::regex option(R"(\s(--?[A-Za-z][\w-]*))");
  std::size_t checked = 0;
  for (const auto& page : pages()) {
    if (page.filename() == "CHANGELOG.md") continue;  // it describes earlier versions
    const std::string text = read(page);
    for (std::sregex_iterator it(text.begin(), text.end(), command), end; it != end; ++it) {
      const std::string words = (*it)[2];
      for (std::sregex_iterator at(words.begin(), words.end(), option); at != end; ++at) {
        ++checked;
        EXPECT_EQ(optionsOf((*it)[1]).count((*at)[1]), 1U)
            << projectPath(page) << ": " << it->str() << "\n  " << (*it)[1] << " has no option " << (*at)[1];
      }
    }
  }
  EXPECT_GT(checked, 100U);
}

// File names are unique, so that a search by name finds the right file.
TEST(Names, noTwoFilesOfTheLibrariesHaveOneName) {
  std::map<std::string, std::vector<std::string>> places;
  for (const auto& file : files("libs", {".h", ".cpp"})) places[file.filename()].push_back(projectPath(file));
  // Each feature has a register.cpp, and RelativeMotion.h of `plugin` only makes that of `motion` available.
  for (const char* shared : {"register.cpp", "RelativeMotion.h"}) places.erase(shared);
  for (const auto& [name, paths] : places) {
    std::string all;
    for (const auto& each : paths) all += " " + each;
    EXPECT_EQ(paths.size(), 1U) << name << " is there more than once:" << all;
  }
}

// The name of a number ends in its unit, except for shares, factors, probabilities, numbers of standard deviations and
// the keys listed below.
TEST(Names, numbersEndInTheirUnit) {
  const std::regex unit(R"((_m|_m2|_m3|_deg|_s|_hz|_px|_px2|_mb|_rad|_pixels)$|_per_)");
  const std::regex dimensionless(
      R"((confidence|probability|inflation|ratio|share|factor|scale|score|overlap|sigmas|tolerance|growth|weight|likelihood|hdop)|^relative_|^alike$|_[kp]\d$)");
  const std::set<std::string> others{"origin_latitude",    "origin_longitude",  // degrees, as every GPS gives them
                                     "degrees_of_freedom",                      // of a distribution
                                     "correlated_points",                       // a number of points
                                     "brightness_noise",   "least_change",     "max_colour_distance",
                                     "rgb_high",           "rgb_low"};  // levels of grey
  const std::regex row(R"(^\| `(\w+)` \| number \|)");
  std::size_t checked = 0;
  for (const auto& line : lines(read(omnimapper::testing::sourceFile("ini/README.md")))) {
    std::smatch key;
    if (!std::regex_search(line, key, row)) continue;
    ++checked;
    const std::string name = key[1];
    EXPECT_TRUE(std::regex_search(name, unit) || std::regex_search(name, dimensionless) || others.count(name) > 0)
        << "ini/README.md: " << name << " does not say its unit";
  }
  EXPECT_GT(checked, 150U);
}

}  // namespace
