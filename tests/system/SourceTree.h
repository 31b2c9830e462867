#pragma once

#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

/// The project's own source tree, read as text.
namespace source_tree {

namespace fs = std::filesystem;

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// Files below a folder of the project whose names end in one of the extensions (all, if none is given), sorted.
inline std::vector<fs::path> files(const std::string& folder, const std::vector<std::string>& extensions = {}) {
  std::vector<fs::path> found;
  const fs::path root = omnimapper::testing::sourceFile(folder);
  if (!fs::exists(root)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    const std::string extension = entry.path().extension();
    const bool wanted = extensions.empty() || std::count(extensions.begin(), extensions.end(), extension) > 0;
    if (wanted) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Names of the folders directly below a folder of the project, sorted.
inline std::vector<std::string> folders(const std::string& folder) {
  std::vector<std::string> found;
  const fs::path root = omnimapper::testing::sourceFile(folder);
  if (!fs::exists(root)) return found;
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.is_directory()) found.push_back(entry.path().filename());
  }
  std::sort(found.begin(), found.end());
  return found;
}

inline std::string projectPath(const fs::path& file) {
  return fs::relative(file, omnimapper::testing::sourceFile("")).string();
}

/// First group of every match of a pattern.
inline std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

/// C++ text with comments and the content of string and character literals blanked; line breaks stay.
inline std::string codeOnly(const std::string& text) {
  std::string code;
  std::size_t i = 0;
  const auto skipTo = [&](std::size_t end) {
    for (end = std::min(end, text.size()); i < end; ++i) code += text[i] == '\n' ? '\n' : ' ';
  };
  const auto after = [&](const std::string& mark, std::size_t from) {
    const std::size_t at = text.find(mark, from);
    return at == std::string::npos ? text.size() : at + mark.size();
  };
  const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  while (i < text.size()) {
    const char c = text[i];
    if (text.compare(i, 2, "//") == 0) {
      skipTo(std::min(text.find('\n', i), text.size()));
    } else if (text.compare(i, 2, "/*") == 0) {
      skipTo(after("*/", i + 2));
    } else if (text.compare(i, 2, "R\"") == 0 && (i == 0 || !isWord(text[i - 1]))) {
      const std::size_t open = text.find('(', i);
      skipTo(after(")" + text.substr(i + 2, open - i - 2) + "\"", open));
    } else if (c == '"' || (c == '\'' && (i == 0 || !isWord(text[i - 1])))) {  // 1'000 is a number
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != c) end += text[end] == '\\' ? 2 : 1;
      skipTo(end + 1);
    } else {
      code += c;
      ++i;
    }
  }
  return code;
}

}  // namespace source_tree
