#include "cameraByName.h"

#include <cctype>
#include <fstream>

namespace omnimapper::source {

namespace fs = std::filesystem;

namespace {

// Whether a folder's path contains `word` as a whole word, with no letter beside it and no digit beside its number:
// "vehicles" and "iclr" do not contain "icl", and "fr12" does not contain "fr1".
bool hasWord(const fs::path& folder, const std::string& word) {
  const std::string name = fs::absolute(folder).lexically_normal().string();
  const auto goesOn = [](char inside, char beside) {
    const auto of = [](char c, auto is) { return is(static_cast<unsigned char>(c)) != 0; };
    const auto isDigit = [](int c) { return std::isdigit(c); };
    const auto isLetter = [](int c) { return std::isalpha(c); };
    return of(beside, isLetter) || (of(inside, isDigit) && of(beside, isDigit));
  };
  for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !goesOn(word.front(), name[at - 1]);
    if (begins && (end == name.size() || !goesOn(word.back(), name[end]))) return true;
  }
  return false;
}

std::string freiburgOf(const fs::path& folder) {
  for (const char number : {'1', '2', '3'}) {
    for (const char* word : {"freiburg", "fr"}) {
      if (hasWord(folder, word + std::string(1, number))) return std::string("freiburg") + number;
    }
  }
  // A renamed folder still names the camera at the top of its lists: "# file: 'rgbd_dataset_freiburg1_rpy.bag'".
  std::ifstream list(folder / "depth.txt");
  constexpr int kHeading = 3;
  std::string line;
  for (int i = 0; i < kHeading && std::getline(list, line); ++i) {
    const std::size_t at = line.find("freiburg");
    if (line.rfind('#', 0) != 0 || at == std::string::npos || at + 8 >= line.size()) continue;
    const char number = line[at + 8];
    if (number >= '1' && number <= '3') return std::string("freiburg") + number;
  }
  return "";
}

// The folder of a sequence, as chess/seq-01.
bool isOfSevenScenes(const fs::path& folder) {
  for (const char* word : {"7-scenes", "7scenes", "7_scenes", "7-Scenes", "7Scenes"})
    if (hasWord(folder, word)) return true;
  const fs::path path = fs::absolute(folder / ".").lexically_normal().parent_path();
  if (path.filename().string().rfind("seq-", 0) != 0) return false;
  for (const char* scene : {"chess", "fire", "heads", "office", "pumpkin", "redkitchen", "stairs"})
    if (path.parent_path().filename() == scene) return true;
  return false;
}

}  // namespace

std::string cameraByName(const fs::path& folder) {
  if (hasWord(folder, "icl") || hasWord(folder, "ICL")) return "icl_nuim";
  if (isOfSevenScenes(folder)) return "7_scenes";
  return freiburgOf(folder);
}

}  // namespace omnimapper::source
