#include <omnimapper/base/Exceptions.h>

namespace omnimapper::base {

std::string sentenceOf(const std::exception& error) {
  const std::string text = error.what(), label = "Message:", banner = "==== MRPT exception ====\n";
  const std::size_t found = text.find(label);
  std::size_t begin = std::string::npos;
  if (found != std::string::npos) {
    begin = text.find_first_not_of(' ', found + label.size());
  } else if (text.compare(0, banner.size(), banner) == 0) {
    begin = banner.size();  // it wraps an exception of another library
  }
  return begin == std::string::npos ? text : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace omnimapper::base
