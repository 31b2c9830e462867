#include <omnimapper/server/HttpMessage.h>

#include <optional>
#include <string_view>

namespace omnimapper::server {

namespace {

int digitOf(char letter) {
  if (letter >= '0' && letter <= '9') return letter - '0';
  if (letter >= 'a' && letter <= 'f') return letter - 'a' + 10;
  if (letter >= 'A' && letter <= 'F') return letter - 'A' + 10;
  return -1;
}

bool isControl(char letter) {
  return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
}

std::optional<std::string> decoded(std::string_view text, bool plus_is_blank) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char letter = text[i] == '+' && plus_is_blank ? ' ' : text[i];
    if (text[i] == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = digitOf(text[i + 1]), low = digitOf(text[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      letter = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (isControl(letter)) return std::nullopt;
    plain += letter;
  }
  return plain;
}

bool readValues(std::string_view text, std::map<std::string, std::string>& values) {
  while (!text.empty()) {
    const auto end = text.find('&');
    const std::string_view pair = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (pair.empty()) continue;
    const auto equals = pair.find('=');
    const auto name = decoded(pair.substr(0, equals), true);
    const auto value = equals == std::string_view::npos ? std::string() : decoded(pair.substr(equals + 1), true);
    if (!name || !value) return false;
    values.emplace(*name, *value);
  }
  return true;
}

}  // namespace

HttpResponse refusal(int status, const std::string& sentence) {
  return {status, "text/plain; charset=utf-8", sentence + "\n"};
}

bool readTarget(const std::string& target, HttpRequest& request) {
  if (target.empty() || target.front() != '/') return false;
  const std::string_view text = target;
  const auto question = text.find('?');
  const auto path = decoded(text.substr(0, question), false);
  if (!path) return false;
  request.path = *path;
  return question == std::string_view::npos || readValues(text.substr(question + 1), request.values);
}

}  // namespace omnimapper::server
