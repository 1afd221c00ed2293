// A JSON document in little memory: twelve bytes per value, plus the strings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace holomorph {

/// A JSON document. Numbers are kept exactly as far as 64 bits allow. If a key occurs several times
/// in an object, the last member counts. Cost: linear time, and at most six times the size of the
/// text in memory.
class JsonTree {
 public:
  /// Throws Error{bad_input} if the text is not JSON, saying where, or if brackets are nested more
  /// than `deepest` deep.
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
    Value item(size_t i) const;  ///< of a list
    std::string_view key(size_t i) const;
    Value member(size_t i) const;  ///< of an object
    /// Appends the value as JSON text, without blanks.
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
  /// Kind and count share a word. The count is the length of a string, or the number of items or
  /// members. The other 64 bits are the bits of a number, the start of a string, or the index of
  /// the first child. They are stored in two halves so that no space is lost to alignment.
  struct Node {
    std::uint32_t kind : 3, count : 29;
    std::uint32_t low, high;

    std::uint64_t bits() const { return static_cast<std::uint64_t>(high) << 32 | low; }
  };

  std::vector<Node> nodes_;  ///< children of one parent are contiguous, each key before its value
  std::string texts_;
};

}  // namespace holomorph
