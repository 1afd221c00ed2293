// A compact JSON document that needs twelve bytes per value, plus the strings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace holomorph {

/// A JSON document. Integers that fit in 64 bits are exact. If a key occurs several times in an
/// object, its last occurrence is used. Cost: linear time, and memory at most six times the size of
/// the text.
class JsonTree {
 public:
  /// Throws Error{bad_input} with the position of the error if the text is not JSON, or if brackets
  /// are nested more than `deepest` levels deep.
  JsonTree(const std::string& text, int deepest);
  JsonTree(const JsonTree&) = delete;
  JsonTree& operator=(const JsonTree&) = delete;

  enum class Kind : std::uint8_t { null, boolean, integer, natural, real, text, list, object };

  /// A value of a tree. The tree must outlive it.
  class Value {
   public:
    Kind kind() const;
    bool is_number() const { return kind() >= Kind::integer && kind() <= Kind::real; }
    bool truth() const;
    double number() const;
    std::string_view text() const;
    /// The number of items of a list, or of members of an object.
    size_t size() const;
    Value item(size_t i) const;  ///< the item of a list at an index
    std::string_view key(size_t i) const;
    Value member(size_t i) const;  ///< the value of an object's member at an index
    /// Appends the value to a string as JSON text without blanks.
    void write(std::string& out) const;

   private:
    friend class JsonTree;
    Value(const JsonTree& tree, size_t node) : tree_(&tree), node_(node) {}
    const JsonTree* tree_;
    size_t node_;
  };
  Value root() const { return {*this, 0}; }

 private:
  struct Count;
  struct Fill;
  /// The kind and the count share one word. The count is the length of a string, or the number of
  /// items or members. The other 64 bits contain a number, the start of a string, or the index of
  /// the first child. They are stored in two halves to avoid padding.
  struct Node {
    std::uint32_t kind : 3, count : 29;
    std::uint32_t low, high;

    std::uint64_t bits() const { return static_cast<std::uint64_t>(high) << 32 | low; }
  };

  std::vector<Node> nodes_;  ///< siblings are contiguous; each key precedes its value
  std::string texts_;
};

}  // namespace holomorph
