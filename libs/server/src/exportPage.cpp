#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/server/ServedMap.h>
#include <omnimapper/server/exportPage.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <regex>
#include <system_error>
#include <vector>

#include "bundled.h"

namespace omnimapper::server {

namespace fs = std::filesystem;

namespace {

constexpr char kModule[] = R"(<script type="module" src="app.js"></script>)";
constexpr char kScripts[] = R"(<script defer src="map.js"></script><script defer src="page.js"></script>)";

std::map<std::string, std::string> filesOf(const std::string& folder) {
  std::map<std::string, std::string> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.is_regular_file(missing))
      files[entry.path().filename().string()] = base::readInput(entry.path().string(), "page");
  if (files.count("index.html") == 0 || files["index.html"].find(kModule) == std::string::npos)
    throw base::Error(base::ExitCode::unreadable_input, folder + ": has no page: install OmniMapper again");
  return files;
}

void refuseSame(const std::string& output, const std::string& folder, const std::string& what) {
  std::error_code missing;
  if (fs::equivalent(output, folder, missing))
    throw base::Error(base::ExitCode::command_line, output + ": is " + what + "; name another one");
}

/// Removes the pictures of an earlier copy, which may be of things that are gone.
void removePictures(const std::string& folder) {
  static const std::regex picture(R"(picture-\d+-\d+\.png)");
  std::vector<fs::path> old;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (std::regex_match(entry.path().filename().string(), picture)) old.push_back(entry.path());
  for (const auto& file : old) fs::remove(file, missing);
}

void put(const std::string& folder, const std::string& name, const std::string& bytes) {
  base::writeFile((fs::path(folder) / name).string(), [&](std::ostream& out) { out << bytes; });
}

std::string trimmedEnd(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// A copy has no view in 3D.
std::string documentOf(const ServedMap& map) {
  auto document = nlohmann::ordered_json::parse(map.document());
  document["solid"] = nullptr;
  return document.dump();
}

std::string dataOf(const ServedMap& map) {
  const std::string grid = map.gridPng().empty() ? "" : "data:image/png;base64," + draw::encodeBase64(map.gridPng());
  return "globalThis.omnimapperMap = {\n\"map\": " + documentOf(map) +
         ",\n\"trajectory\": " + trimmedEnd(map.trajectory()) + ",\n\"about\": " + trimmedEnd(map.about()) +
         ",\n\"grid\": \"" + grid + "\"\n};\n";
}

}  // namespace

void exportPage(const std::string& path, const std::string& page_folder, const std::string& output) {
  const ServedMap map(path);
  const auto files = filesOf(page_folder);
  base::makeWritableFolder(output);
  refuseSame(output, map.map().folder, "the folder of the map");
  refuseSame(output, page_folder, "the folder of the page that comes with this program");
  removePictures(output);
  for (const auto& place : map.map().places.places) {
    std::string id = toString(place.id);
    const auto picture = map.pictureOf(id);
    std::replace(id.begin(), id.end(), ':', '-');
    if (picture) put(output, "picture-" + id + ".png", *picture);
  }
  for (const auto& [name, bytes] : files)
    if (const auto kind = fs::path(name).extension(); kind == ".css" || kind == ".svg") put(output, name, bytes);
  put(output, "page.js", bundled(files, "app.js"));
  put(output, "map.js", dataOf(map));
  std::string index = files.at("index.html");
  index.replace(index.find(kModule), sizeof kModule - 1, kScripts);
  put(output, "index.html", index);
}

}  // namespace omnimapper::server
