// nlohmann-json parses the text twice. The first pass counts the values. The second pass fills
// arrays that have exactly the right size. The library's own tree would take about 40 times the
// memory of the text.
#include "scene/formats/json_tree.h"

#include <bit>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace holomorph {

/// Counts the items of each list and object, in the order in which the lists and objects begin.
struct JsonTree::Count : nlohmann::json_sax<nlohmann::json> {
  explicit Count(int deepest) : deepest_(deepest) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t& text) override {
    texts += text.size();
    return value();
  }
  bool binary(binary_t&) override { return false; }
  bool key(string_t& text) override {
    texts += text.size();
    ++nodes;
    return true;
  }
  bool start_object(size_t) override { return begin(); }
  bool start_array(size_t) override { return begin(); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool parse_error(size_t, const std::string&, const nlohmann::json::exception& error) override {
    problem = error.what();
    return false;
  }

  std::vector<std::uint32_t> counts;
  size_t nodes = 0, texts = 0;
  std::string problem;

 private:
  bool value() {
    ++nodes;
    if (!open_.empty()) ++counts[open_.back()];
    return true;
  }
  bool begin() {
    value();
    open_.push_back(counts.size());
    counts.push_back(0);
    if (open_.size() <= static_cast<size_t>(deepest_)) return true;
    problem = "brackets are nested more than " + std::to_string(deepest_) + " levels deep";
    return false;
  }
  bool end() {
    open_.pop_back();
    return true;
  }

  int deepest_;
  std::vector<size_t> open_;
};

struct JsonTree::Fill : nlohmann::json_sax<nlohmann::json> {
  Fill(JsonTree& tree, const std::vector<std::uint32_t>& counts) : tree_(tree), counts_(counts) {}

  bool null() override { return put(Kind::null, 0, 0); }
  bool boolean(bool truth) override { return put(Kind::boolean, 0, truth); }
  bool number_integer(number_integer_t number) override {
    return put(Kind::integer, 0, std::bit_cast<std::uint64_t>(number));
  }
  bool number_unsigned(number_unsigned_t number) override { return put(Kind::natural, 0, number); }
  bool number_float(number_float_t number, const string_t&) override {
    return put(Kind::real, 0, std::bit_cast<std::uint64_t>(number));
  }
  bool string(string_t& text) override { return put_text(text); }
  bool key(string_t& text) override { return put_text(text); }
  bool binary(binary_t&) override { return false; }
  bool start_object(size_t) override { return begin(Kind::object, 2); }
  bool start_array(size_t) override { return begin(Kind::list, 1); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool parse_error(size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  bool put(Kind kind, size_t count, std::uint64_t bits) {
    const size_t place = open_.empty() ? 0 : open_.back()++;
    tree_.nodes_[place] = {static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(count),
                           static_cast<std::uint32_t>(bits),
                           static_cast<std::uint32_t>(bits >> 32)};
    return true;
  }
  bool put_text(const std::string& text) {
    const size_t start = tree_.texts_.size();
    tree_.texts_ += text;
    return put(Kind::text, text.size(), start);
  }
  bool begin(Kind kind, size_t per_item) {
    const size_t count = counts_[next_++];
    put(kind, count, used_);
    open_.push_back(used_);
    used_ += per_item * count;
    return true;
  }
  bool end() {
    open_.pop_back();
    return true;
  }

  JsonTree& tree_;
  const std::vector<std::uint32_t>& counts_;
  size_t next_ = 0, used_ = 1;
  std::vector<size_t> open_;  ///< index of the next child of each open list or object
};

JsonTree::JsonTree(const std::string& text, int deepest) {
  constexpr size_t kLargest = size_t{1} << 29;  // counts must be less than this
  if (text.size() >= kLargest) throw Error(ErrorKind::bad_input, "the text is larger than 512 MB");
  Count count(deepest);
  if (!nlohmann::json::sax_parse(text, &count)) throw Error(ErrorKind::bad_input, count.problem);
  nodes_.resize(count.nodes);
  texts_.reserve(count.texts);
  Fill fill(*this, count.counts);
  check(nlohmann::json::sax_parse(text, &fill), "JSON that was counted can be read");
}

JsonTree::Kind JsonTree::Value::kind() const {
  return static_cast<Kind>(tree_->nodes_[node_].kind);
}

bool JsonTree::Value::truth() const {
  return tree_->nodes_[node_].low != 0;
}

double JsonTree::Value::number() const {
  const std::uint64_t bits = tree_->nodes_[node_].bits();
  return kind() == Kind::real      ? std::bit_cast<double>(bits)
         : kind() == Kind::natural ? static_cast<double>(bits)
                                   : static_cast<double>(std::bit_cast<std::int64_t>(bits));
}

std::string_view JsonTree::Value::text() const {
  const Node& node = tree_->nodes_[node_];
  return std::string_view(tree_->texts_).substr(node.bits(), node.count);
}

size_t JsonTree::Value::size() const {
  return tree_->nodes_[node_].count;
}

JsonTree::Value JsonTree::Value::item(size_t i) const {
  return {*tree_, tree_->nodes_[node_].bits() + i};
}

std::string_view JsonTree::Value::key(size_t i) const {
  return Value(*tree_, tree_->nodes_[node_].bits() + 2 * i).text();
}

JsonTree::Value JsonTree::Value::member(size_t i) const {
  return {*tree_, tree_->nodes_[node_].bits() + 2 * i + 1};
}

namespace {

void write_text(std::string_view text, std::string& out) {
  out += nlohmann::json(text).dump();
}

}  // namespace

void JsonTree::Value::write(std::string& out) const {
  const std::uint64_t bits = tree_->nodes_[node_].bits();
  switch (kind()) {
    case Kind::null:
      out += "null";
      break;
    case Kind::boolean:
      out += truth() ? "true" : "false";
      break;
    case Kind::integer:
      out += std::to_string(std::bit_cast<std::int64_t>(bits));
      break;
    case Kind::natural:
      out += std::to_string(bits);
      break;
    case Kind::real:
      out += nlohmann::json(number()).dump();
      break;
    case Kind::text:
      write_text(text(), out);
      break;
    case Kind::list:
      out += '[';
      for (size_t i = 0; i < size(); ++i) {
        if (i > 0) out += ',';
        item(i).write(out);
      }
      out += ']';
      break;
    case Kind::object:
      out += '{';
      for (size_t i = 0; i < size(); ++i) {
        if (i > 0) out += ',';
        write_text(key(i), out);
        out += ':';
        member(i).write(out);
      }
      out += '}';
      break;
  }
}

}  // namespace holomorph
