#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/net/Network.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "Session.h"

namespace omnimapper::net {

std::string modelsFolder() {
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  const bool has_data = data != nullptr && *data == '/';
  return (has_data ? data : std::string(home != nullptr ? home : "") + "/.local/share") + "/omnimapper/models";
}

Network::Network(const std::string& path, Backend backend, const std::string& library)
    : path_(path), backend_(backend), library_(library) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || std::filesystem::file_size(path, ignored) == 0)
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": the network is missing or empty; scripts/models fetches networks");
  idle_.push_back(take());
}

Network::~Network() = default;

std::string asOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return base::printable(text);
}

std::unique_ptr<Session> Network::take() const {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto session = std::move(idle_.back());
      idle_.pop_back();
      return session;
    }
  }
  return backend_ == Backend::opencv ? openWithOpenCv(path_) : openWithOnnxRuntime(path_, library_);
}

Tensor Network::run(const Tensor& input) const {
  auto session = take();
  auto output = session->run(input);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(session));
  return output;
}

}  // namespace omnimapper::net
