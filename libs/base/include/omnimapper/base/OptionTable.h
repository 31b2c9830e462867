#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::base {

/// One option of a section of an INI file, as a user reads and writes it: all values are text, in the unit of the key.
struct OptionSpec {
  std::string key;            ///< ends in the unit of the value, if it has one: _m, _deg, _s, _hz, ...
  std::string type;           ///< "number", "integer", "flag", "text", "list" or "choice"
  std::string default_value;  ///< as it would be written in an INI file
  std::string range;          ///< "[0, 1]", "a | b | c", or empty
  std::string help;           ///< meaning of the option, one or more sentences
};

/// Bounds of a number, inclusive, in the unit of the key.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  static Range positive() { return {std::numeric_limits<double>::min(), std::numeric_limits<double>::infinity()}; }
  static Range notNegative() { return {0.0, std::numeric_limits<double>::infinity()}; }
};

/// Why a value was refused. ConfigSection adds file, section and key to the message.
struct BadValue {
  enum class Kind { type, range } kind;
  std::string expected;
};

/// Declares the options of a struct once: key, member, bounds, help. The default is the initial value of the member.
/// A number whose key ends in "_deg" is in degrees in the file and in radians in the member. All other numbers are the
/// same in both.
///
/// struct TriggerOptions {
///   double distance = 0.5;  // [m]
///   static const OptionTable<TriggerOptions>& table();
/// };
/// const OptionTable<TriggerOptions>& TriggerOptions::table() {
///   static const auto table = OptionTable<TriggerOptions>()
///       .number("distance_m", &TriggerOptions::distance, Range::positive(), "Distance between key frames.");
///   return table;
/// }
template <class Struct>
class OptionTable {
 public:
  OptionTable& number(const std::string& key, double Struct::*member, Range range, const std::string& help);
  /// A number that has no default: the member stays empty if the file does not have the key.
  OptionTable& number(const std::string& key, std::optional<double> Struct::*member, Range range,
                      const std::string& help);
  OptionTable& integer(const std::string& key, int Struct::*member, Range range, const std::string& help);
  /// An integer that has no default: the member stays empty if the file does not have the key.
  OptionTable& integer(const std::string& key, std::optional<int> Struct::*member, Range range,
                       const std::string& help);
  OptionTable& flag(const std::string& key, bool Struct::*member, const std::string& help);
  OptionTable& text(const std::string& key, std::string Struct::*member, const std::string& help);
  /// A list of names, which are separated by commas or blanks in the file.
  OptionTable& list(const std::string& key, std::vector<std::string> Struct::*member, const std::string& help);
  template <class Enum>
  OptionTable& choice(const std::string& key, Enum Struct::*member,
                      const std::vector<std::pair<std::string, Enum>>& names, const std::string& help);

  const std::vector<OptionSpec>& specs() const { return specs_; }

  /// Sets option number `index` of `target` from text. Returns null, or the reason if the text does not fit.
  std::unique_ptr<BadValue> set(Struct& target, std::size_t index, const std::string& text) const {
    return setters_[index](target, text);
  }

 private:
  using Setter = std::function<std::unique_ptr<BadValue>(Struct&, const std::string&)>;
  OptionTable& add(OptionSpec spec, Setter setter) {
    specs_.push_back(std::move(spec));
    setters_.push_back(std::move(setter));
    return *this;
  }

  std::vector<OptionSpec> specs_;
  std::vector<Setter> setters_;
};

/// Conversions between texts and values, which OptionTable uses for every options struct.
namespace option_text {
bool isAngleInDegrees(const std::string& key);
std::string format(double value);
std::string format(const std::vector<std::string>& names);
std::string format(const Range& range);
/// Each function parse() returns null, or the reason if `text` does not fit; `value` is then left unchanged.
std::unique_ptr<BadValue> parse(const std::string& text, const Range& range, double& value);
std::unique_ptr<BadValue> parse(const std::string& text, const Range& range, int& value);
std::unique_ptr<BadValue> parse(const std::string& text, bool& value);
std::vector<std::string> parseList(const std::string& text);
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
}  // namespace option_text

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::number(const std::string& key, double Struct::*member, Range range,
                                                 const std::string& help) {
  const double unit = option_text::isAngleInDegrees(key) ? option_text::kRadiansPerDegree : 1.0;
  return add({key, "number", option_text::format(Struct{}.*member / unit), option_text::format(range), help},
             [=](Struct& target, const std::string& text) {
               double value = 0;
               auto bad = option_text::parse(text, range, value);
               if (!bad) target.*member = value * unit;
               return bad;
             });
}

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::number(const std::string& key, std::optional<double> Struct::*member,
                                                 Range range, const std::string& help) {
  const double unit = option_text::isAngleInDegrees(key) ? option_text::kRadiansPerDegree : 1.0;
  return add({key, "number", "", option_text::format(range), help}, [=](Struct& target, const std::string& text) {
    double value = 0;
    auto bad = option_text::parse(text, range, value);
    if (!bad) target.*member = value * unit;
    return bad;
  });
}

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::integer(const std::string& key, int Struct::*member, Range range,
                                                  const std::string& help) {
  return add({key, "integer", std::to_string(Struct{}.*member), option_text::format(range), help},
             [=](Struct& target, const std::string& text) { return option_text::parse(text, range, target.*member); });
}

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::integer(const std::string& key, std::optional<int> Struct::*member,
                                                  Range range, const std::string& help) {
  return add({key, "integer", "", option_text::format(range), help}, [=](Struct& target, const std::string& text) {
    int value = 0;
    auto bad = option_text::parse(text, range, value);
    if (!bad) target.*member = value;
    return bad;
  });
}

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::flag(const std::string& key, bool Struct::*member, const std::string& help) {
  return add({key, "flag", Struct{}.*member ? "true" : "false", "true | false", help},
             [=](Struct& target, const std::string& text) { return option_text::parse(text, target.*member); });
}

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::text(const std::string& key, std::string Struct::*member,
                                               const std::string& help) {
  return add({key, "text", Struct{}.*member, "", help}, [=](Struct& target, const std::string& text) {
    target.*member = text;
    return std::unique_ptr<BadValue>();
  });
}

template <class Struct>
OptionTable<Struct>& OptionTable<Struct>::list(const std::string& key, std::vector<std::string> Struct::*member,
                                               const std::string& help) {
  return add({key, "list", option_text::format(Struct{}.*member), "", help},
             [=](Struct& target, const std::string& text) {
               target.*member = option_text::parseList(text);
               return std::unique_ptr<BadValue>();
             });
}

template <class Struct>
template <class Enum>
OptionTable<Struct>& OptionTable<Struct>::choice(const std::string& key, Enum Struct::*member,
                                                 const std::vector<std::pair<std::string, Enum>>& names,
                                                 const std::string& help) {
  std::string range, default_value;
  for (const auto& [name, value] : names) {
    range += (range.empty() ? "" : " | ") + name;
    if (value == Struct{}.*member) default_value = name;
  }
  return add({key, "choice", default_value, range, help}, [=](Struct& target, const std::string& text) {
    for (const auto& [name, value] : names) {
      if (name == text) {
        target.*member = value;
        return std::unique_ptr<BadValue>();
      }
    }
    return std::make_unique<BadValue>(BadValue{BadValue::Kind::type, "one of " + range});
  });
}

}  // namespace omnimapper::base
