// Reads JSON values. Each value stores its position in the document for error messages.
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "scene/formats/json_tree.h"
#include "scene/scene.h"

namespace holomorph {

using Json = nlohmann::ordered_json;

/// A JSON value and its position. Error messages include the position.
class Reader {
 public:
  using Kind = JsonTree::Kind;

  Reader(JsonTree::Value value, const std::string& name, std::string pointer)
      : value_(value), name_(&name), pointer_(std::move(pointer)) {}

  [[noreturn]] void fail(const std::string& reason, std::optional<Complex> where = {}) const {
    throw Error(ErrorKind::bad_input,
                *name_ + ": " + (pointer_.empty() ? "/" : pointer_) + ": " + reason, where);
  }

  const Reader& object() const {
    if (value_.kind() != Kind::object) fail("expected an object, found " + kind());
    return *this;
  }
  const Reader& array() const {
    if (value_.kind() != Kind::list) fail("expected an array, found " + kind());
    return *this;
  }
  size_t size() const {
    return value_.kind() == Kind::list || value_.kind() == Kind::object ? value_.size() : 0;
  }
  bool has(std::string_view key) const { return found(key) < size(); }
  Reader operator[](const char* key) const {
    const size_t i = found(key);
    if (i >= size()) fail(std::string("the key '") + key + "' is missing");
    return {value_.member(i), *name_, pointer_ + "/" + key};
  }
  Reader operator[](size_t i) const {
    return {value_.item(i), *name_, pointer_ + "/" + std::to_string(i)};
  }

  double number() const {
    if (!value_.is_number()) fail("expected a number, found " + kind());
    const double number = value_.number();
    if (!std::isfinite(number)) fail("the number is not finite");
    return number;
  }
  double within(double lowest, double highest) const {
    const double n = number();
    if (!(n >= lowest && n <= highest))
      fail("expected a number in [" + Json(lowest).dump() + ", " + Json(highest).dump() + "]");
    return n;
  }
  int whole(int lowest, int highest) const {
    const double n = number();
    if (n != std::floor(n) || n < lowest || n > highest)
      fail("expected a whole number in [" + std::to_string(lowest) + ", " +
           std::to_string(highest) + "]");
    return static_cast<int>(n);
  }
  std::string text() const {
    if (value_.kind() != Kind::text) fail("expected a string, found " + kind());
    return std::string(value_.text());
  }
  Complex point() const {
    array();
    if (size() != 2) fail("expected a point [x, y]");
    const Complex z{(*this)[size_t{0}].number(), (*this)[1].number()};
    if (std::abs(z.real()) > kMaxCoordinate || std::abs(z.imag()) > kMaxCoordinate)
      fail("the coordinates are larger than 1e8");
    return z;
  }
  bool truth() const {
    if (value_.kind() != Kind::boolean) fail("expected true or false, found " + kind());
    return value_.truth();
  }
  /// The value of a parameter: a number, or 0 or 1 for a boolean.
  double value() const {
    return value_.kind() == Kind::boolean ? (value_.truth() ? 1.0 : 0.0) : number();
  }

  /// The members whose keys are in neither list, as JSON text; empty if there are none.
  Extra others(std::initializer_list<const char*> known,
               std::initializer_list<const char*> known_too = {}) const {
    const auto is_in = [](std::initializer_list<const char*> list, std::string_view key) {
      return std::find(list.begin(), list.end(), key) != list.end();
    };
    std::string text;
    for (const auto& [key, i] : last_of_each()) {
      if (is_in(known, key) || is_in(known_too, key)) continue;
      text += (text.empty() ? "{" : ",") + Json(key).dump() + ":";
      value_.member(i).write(text);
    }
    return text.empty() ? "" : text + "}";
  }
  /// All members of an object with their keys.
  std::vector<std::pair<std::string, Reader>> members() const {
    std::vector<std::pair<std::string, Reader>> all;
    for (const auto& [key, i] : last_of_each())
      all.emplace_back(key, Reader(value_.member(i), *name_, pointer_ + "/" + std::string(key)));
    return all;
  }

 private:
  /// The index of the last member with a key; size() if there is none.
  size_t found(std::string_view key) const {
    if (value_.kind() != Kind::object) return size();
    for (size_t i = size(); i-- > 0;)
      if (value_.key(i) == key) return i;
    return size();
  }
  /// Each distinct key, in order of first occurrence, with the index of its last occurrence.
  std::vector<std::pair<std::string_view, size_t>> last_of_each() const {
    std::vector<std::uint32_t> sorted(size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    std::ranges::sort(sorted, {}, [&](std::uint32_t i) { return std::pair(value_.key(i), i); });
    std::vector<std::uint32_t> last(size());  // kNone except at first occurrences
    constexpr std::uint32_t kNone = 0xffffffff;
    for (size_t i = 0; i < sorted.size();) {
      size_t end = i + 1;
      while (end < sorted.size() && value_.key(sorted[end]) == value_.key(sorted[i])) ++end;
      last[sorted[i]] = sorted[end - 1];
      while (++i < end) last[sorted[i]] = kNone;
    }
    std::vector<std::pair<std::string_view, size_t>> all;
    for (size_t i = 0; i < last.size(); ++i)
      if (last[i] != kNone) all.emplace_back(value_.key(i), last[i]);
    return all;
  }
  std::string kind() const {
    constexpr const char* kNames[] = {"null",     "a boolean", "a number", "a number",
                                      "a number", "a string",  "an array", "an object"};
    return kNames[static_cast<size_t>(value_.kind())];
  }

  JsonTree::Value value_;
  const std::string* name_;
  std::string pointer_;
};

}  // namespace holomorph
