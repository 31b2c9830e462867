#pragma once

#include <omnimapper/server/HttpMessage.h>

#include <map>
#include <optional>
#include <string>

namespace omnimapper::server {

/// The files of a page, read once. No request names a file of the disk: its path is a key of this table.
class StaticFiles {
 public:
  /// Reads the files of the folder whose kind a page uses (.html, .js, .css, .svg, .png). Throws
  /// Error(unreadable_input), naming the folder and the remedy, if it has no index.html.
  explicit StaticFiles(const std::string& folder);

  /// The file of that path, "/plan.js"; "/" is index.html. None if there is none.
  std::optional<HttpResponse> find(const std::string& path) const;

 private:
  struct File {
    std::string content_type, bytes;
  };
  std::map<std::string, File> files_;
};

}  // namespace omnimapper::server
