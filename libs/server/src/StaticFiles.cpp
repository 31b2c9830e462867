#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/server/StaticFiles.h>

#include <filesystem>
#include <system_error>

namespace omnimapper::server {

namespace fs = std::filesystem;

namespace {

const std::map<std::string, std::string>& kinds() {
  static const std::map<std::string, std::string> kinds{{".html", "text/html; charset=utf-8"},
                                                        {".js", "text/javascript; charset=utf-8"},
                                                        {".css", "text/css; charset=utf-8"},
                                                        {".svg", "image/svg+xml"},
                                                        {".png", "image/png"}};
  return kinds;
}

}  // namespace

StaticFiles::StaticFiles(const std::string& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto kind = kinds().find(entry.path().extension().string());
    if (kind == kinds().end() || !entry.is_regular_file(error)) continue;
    files_["/" + entry.path().filename().string()] = {kind->second, base::readInput(entry.path().string(), "page")};
  }
  const auto index = files_.find("/index.html");
  if (index == files_.end())
    throw base::Error(base::ExitCode::unreadable_input,
                      folder + ": has no index.html: the page of this program is missing; install OmniMapper again");
  files_["/"] = index->second;
}

std::optional<HttpResponse> StaticFiles::find(const std::string& path) const {
  const auto file = files_.find(path);
  if (file == files_.end()) return std::nullopt;
  return HttpResponse{200, file->second.content_type, file->second.bytes};
}

}  // namespace omnimapper::server
