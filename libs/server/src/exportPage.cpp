#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/server/ServedMap.h>
#include <omnimapper/server/exportPage.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <ostream>
#include <system_error>

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

void put(const std::string& folder, const std::string& name, const std::string& bytes) {
  base::writeFile((fs::path(folder) / name).string(), [&](std::ostream& out) { out << bytes; });
}

std::string trimmedEnd(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string dataOf(const ServedMap& map) {
  const std::string grid = map.gridPng().empty() ? "" : "data:image/png;base64," + draw::encodeBase64(map.gridPng());
  return "globalThis.omnimapperMap = {\n\"map\": " + trimmedEnd(map.document()) +
         ",\n\"trajectory\": " + trimmedEnd(map.trajectory()) + ",\n\"grid\": \"" + grid + "\"\n};\n";
}

}  // namespace

void exportPage(const std::string& path, const std::string& page_folder, const std::string& output) {
  const ServedMap map(path);
  const auto files = filesOf(page_folder);
  base::makeWritableFolder(output);
  std::error_code missing;
  if (fs::equivalent(output, map.map().folder, missing))
    throw base::Error(base::ExitCode::command_line, output + ": is the folder of the map; name another one");
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
