// JSON values that know where they stand, for errors that say so.
#pragma once

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/scene.h"

namespace holomorph {

using Json = nlohmann::ordered_json;

inline constexpr double kLargestCoordinate = 1e8;  ///< beyond this they are no picture's

/// A JSON value, where it stands, and how to complain about it.
class Reader {
 public:
  Reader(const Json& value, std::string name, std::string pointer)
      : value_(value), name_(std::move(name)), pointer_(std::move(pointer)) {}

  [[noreturn]] void fail(const std::string& reason, std::optional<Complex> where = {}) const {
    throw Error(ErrorKind::bad_input,
                name_ + ": " + (pointer_.empty() ? "/" : pointer_) + ": " + reason, where);
  }

  const Reader& object() const {
    if (!value_.is_object()) fail("an object is wanted here, not " + kind());
    return *this;
  }
  const Reader& array() const {
    if (!value_.is_array()) fail("a list is wanted here, not " + kind());
    return *this;
  }
  size_t size() const { return value_.size(); }
  bool has(const char* key) const { return value_.contains(key); }
  Reader operator[](const char* key) const {
    if (!has(key)) fail(std::string("the key '") + key + "' is missing");
    return {value_.at(key), name_, pointer_ + "/" + key};
  }
  Reader operator[](size_t i) const {
    return {value_.at(i), name_, pointer_ + "/" + std::to_string(i)};
  }

  double number() const {
    if (!value_.is_number()) fail("a number is wanted here, not " + kind());
    const double number = value_.get<double>();
    if (!std::isfinite(number)) fail("the number is not finite");
    return number;
  }
  double within(double lowest, double highest) const {
    const double n = number();
    if (!(n >= lowest && n <= highest))
      fail("a number from " + Json(lowest).dump() + " to " + Json(highest).dump() +
           " is wanted here");
    return n;
  }
  int whole(int lowest, int highest) const {
    const double n = number();
    if (n != std::floor(n) || n < lowest || n > highest)
      fail("a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest) +
           " is wanted here");
    return static_cast<int>(n);
  }
  std::string text() const {
    if (!value_.is_string()) fail("a text is wanted here, not " + kind());
    return value_.get<std::string>();
  }
  Complex point() const {
    array();
    if (size() != 2) fail("a point [x, y] is wanted here");
    const Complex z{(*this)[size_t{0}].number(), (*this)[1].number()};
    if (std::abs(z.real()) > kLargestCoordinate || std::abs(z.imag()) > kLargestCoordinate)
      fail("the coordinates are larger than 1e8");
    return z;
  }
  bool truth() const {
    if (!value_.is_boolean()) fail("true or false is wanted here, not " + kind());
    return value_.get<bool>();
  }
  /// A parameter: a number, or a switch as 0 or 1.
  double value() const { return value_.is_boolean() ? (value_.get<bool>() ? 1.0 : 0.0) : number(); }

  /// The keys other than the known ones, as text; empty when there are none.
  Extra others(std::initializer_list<const char*> known) const {
    Json rest = Json::object();
    for (const auto& [key, value] : value_.items())
      if (std::find(known.begin(), known.end(), key) == known.end()) rest[key] = value;
    return rest.empty() ? "" : rest.dump();
  }
  std::vector<std::string> keys() const {
    std::vector<std::string> keys;
    for (const auto& [key, value] : value_.items()) keys.push_back(key);
    return keys;
  }

 private:
  std::string kind() const {
    return value_.is_null() ? "null" : std::string("a ") + value_.type_name();
  }

  const Json& value_;
  std::string name_, pointer_;
};

}  // namespace holomorph
