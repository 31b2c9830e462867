#include <omnimapper/base/Exceptions.h>

namespace omnimapper::base {

std::string sentenceOf(const std::exception& error) {
  const std::string text = error.what(), label = "Message:";
  const std::size_t found = text.find(label);
  if (found == std::string::npos) return text;
  const std::size_t begin = text.find_first_not_of(' ', found + label.size());
  return begin == std::string::npos ? text : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace omnimapper::base
