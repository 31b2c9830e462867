#include <omnimapper/base/Error.h>
#include <omnimapper/map/PayloadRegistry.h>

#include <ostream>
#include <sstream>
#include <utility>

namespace omnimapper::map {

namespace {

class UnknownPayload : public LandmarkPayload {
 public:
  UnknownPayload(std::string kind, std::string bytes) : kind_(std::move(kind)), bytes_(std::move(bytes)) {}
  std::string_view kind() const override { return kind_; }
  void write(std::ostream& out) const override { out << bytes_; }

 private:
  std::string kind_, bytes_;
};

}  // namespace

void PayloadRegistry::add(const std::string& kind, Reader reader) {
  if (!readers_.emplace(kind, std::move(reader)).second) {
    throw base::Error(base::ExitCode::internal, "landmark payload '" + kind + "' is registered twice");
  }
}

std::shared_ptr<const LandmarkPayload> PayloadRegistry::read(const std::string& kind, const std::string& bytes) const {
  const auto reader = readers_.find(kind);
  if (reader == readers_.end()) return std::make_shared<UnknownPayload>(kind, bytes);
  std::istringstream in(bytes);
  auto payload = reader->second(in);
  if (in.peek() != std::istringstream::traits_type::eof()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "landmark payload '" + kind +
                          "' has more bytes than its reader reads: it was written by another "
                          "version of its plugin");
  }
  return payload;
}

}  // namespace omnimapper::map
