// JSON as it was read, in little memory: twelve bytes a value, and the texts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace holomorph {

/// A JSON document. Numbers are kept as they are written as far as 64 bits go; of several members
/// with one key the last one counts. Cost: six times the text's size at most, in linear time.
class JsonTree {
 public:
  /// Throws Error{bad_input} saying where the text is not JSON, and for brackets that are nested
  /// deeper than that.
  JsonTree(const std::string& text, int deepest);
  JsonTree(const JsonTree&) = delete;
  JsonTree& operator=(const JsonTree&) = delete;

  enum class Kind : std::uint8_t { null, boolean, integer, natural, real, text, list, object };

  /// One value of a tree that outlives it.
  class Value {
   public:
    Kind kind() const;
    bool is_number() const { return kind() >= Kind::integer && kind() <= Kind::real; }
    bool truth() const;
    double number() const;
    std::string_view text() const;
    /// How many items a list has, or members an object.
    size_t size() const;
    Value item(size_t i) const;  ///< of a list
    std::string_view key(size_t i) const;
    Value member(size_t i) const;  ///< of an object
    /// The JSON text, without blanks.
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
  /// Kind and count share a word: the length of texts, the number of items or members. The rest is
  /// a number in two halves, so that nothing is lost to alignment: its own bits, where a text
  /// starts, or the first child.
  struct Node {
    std::uint32_t kind : 3, count : 29;
    std::uint32_t low, high;

    std::uint64_t bits() const { return static_cast<std::uint64_t>(high) << 32 | low; }
  };

  std::vector<Node> nodes_;  ///< children of one parent lie together, keys before their values
  std::string texts_;
};

}  // namespace holomorph
