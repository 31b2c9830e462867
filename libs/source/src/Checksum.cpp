#include "Checksum.h"

#include <vector>

#include "CompressedFile.h"

namespace omnimapper::source {

bool isVerified(const std::string& path, const std::function<bool(double)>& stop) {
  CompressedFile file(path);
  if (!file.isCompressed()) return false;
  std::vector<char> buffer(1 << 17);
  while (file.ending() == CompressedFile::Ending::open) {
    if (stop(file.fraction())) return false;
    file.read(buffer.data(), buffer.size());
  }
  return file.ending() == CompressedFile::Ending::end;
}

}  // namespace omnimapper::source
