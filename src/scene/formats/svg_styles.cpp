// CSS is read only as far as drawing programs write it.
#include "scene/formats/svg_styles.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "system/text.h"

namespace holomorph {
namespace {

using Declarations = std::vector<std::pair<std::string, std::string>>;

/// The parts of a text between separators that are not in quotes or parentheses.
std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  char quote = 0;
  int depth = 0;
  for (const char c : text) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(') {
      ++depth;
    } else if (c == ')') {
      --depth;
    } else if (c == separator && depth <= 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

Declarations declarations_of(const std::string& text) {
  Declarations found;
  for (const std::string& part : parts_of(text, ';')) {
    const size_t colon = part.find(':');
    if (colon == std::string::npos) continue;
    found.emplace_back(trimmed(std::string_view(part).substr(0, colon)),
                       trimmed(std::string_view(part).substr(colon + 1)));
  }
  return found;
}

std::string text_of(const Declarations& declarations) {
  std::string text;
  for (const auto& [name, value] : declarations) {
    if (!text.empty()) text += ';';
    text += name;
    text += ':';
    text += value;
  }
  return text;
}

void set(Declarations& declarations, const std::string& name, const std::string& value) {
  const auto known = std::ranges::find(declarations, name, &Declarations::value_type::first);
  if (known == declarations.end())
    declarations.emplace_back(name, value);
  else
    known->second = value;
}

/// An element's type, classes and id; an empty type stands for any.
struct SimpleSelector {
  std::string type;
  std::vector<std::string> ids, classes;
  bool is_child = false;  ///< of what the selector before it selects; else any descendant
};

struct Rule {
  std::vector<SimpleSelector> selector;  ///< from the outermost element to the one that is selected
  Declarations declarations;

  /// The numbers of ids, classes and types.
  std::array<size_t, 3> specificity() const {
    std::array<size_t, 3> counts{};
    for (const SimpleSelector& each : selector) {
      counts[0] += each.ids.size();
      counts[1] += each.classes.size();
      counts[2] += !each.type.empty();
    }
    return counts;
  }
};

/// None if the selector is not supported.
std::optional<std::vector<SimpleSelector>> selector_of(const std::string& text) {
  if (text.find_first_of(":[+~\\") != std::string::npos) return {};
  std::vector<SimpleSelector> found;
  bool starts = true, is_child = false;
  std::string* part = nullptr;
  for (const char c : trimmed(text)) {
    if (c == '>' || std::isspace(static_cast<unsigned char>(c))) {
      is_child = is_child || c == '>';
      starts = true;
      continue;
    }
    if (starts) {
      found.push_back({.type = {}, .ids = {}, .classes = {}, .is_child = is_child});
      part = &found.back().type;
      starts = is_child = false;
    }
    if (c == '.') {
      part = &found.back().classes.emplace_back();
    } else if (c == '#') {
      part = &found.back().ids.emplace_back();
    } else if (c != '*') {
      *part += c;
    }
  }
  return found.empty() ? std::nullopt : std::optional(found);
}

bool selects(const SimpleSelector& selector, const pugi::xml_node& node) {
  if (!selector.type.empty() && selector.type != local_name(node)) return false;
  const std::string id = node.attribute("id").as_string();
  if (std::ranges::any_of(selector.ids, [&](const std::string& wanted) { return wanted != id; }))
    return false;
  if (selector.classes.empty()) return true;
  std::string padded = " ";
  for (const char c : std::string_view(node.attribute("class").as_string()))
    padded += std::isspace(static_cast<unsigned char>(c)) ? ' ' : c;
  padded += ' ';
  return std::ranges::all_of(selector.classes, [&](const std::string& wanted) {
    return padded.find(" " + wanted + " ") != std::string::npos;
  });
}

bool selects(std::span<const SimpleSelector> selector, pugi::xml_node node) {
  if (!selects(selector.back(), node)) return false;
  if (selector.size() == 1) return true;
  const auto outer = selector.first(selector.size() - 1);
  for (pugi::xml_node above = node.parent(); above; above = above.parent()) {
    if (selects(outer, above)) return true;
    if (selector.back().is_child) break;
  }
  return false;
}

/// The text without what lies between two marks, and without the marks.
std::string without(const std::string& text, std::string_view open, std::string_view close) {
  std::string rest;
  for (size_t at = 0; at < text.size();) {
    const size_t from = std::min(text.find(open, at), text.size());
    rest.append(text, at, from - at);
    if (from == text.size()) break;
    const size_t end = text.find(close, from + open.size());
    at = end == std::string::npos ? text.size() : end + close.size();
  }
  return rest;
}

std::string without_comments(const std::string& text) {
  // The marks of XML comments may surround a style sheet, which counts nevertheless.
  return without(without(without(text, "/*", "*/"), "<!--", ""), "-->", "");
}

/// The rules of style sheets.
struct Sheets {
  std::vector<Rule> rules;
  std::string at_rules;
  bool has_others = false;

  void add(const std::string& text) {
    for (size_t at = 0; at < text.size();) {
      const size_t open = text.find('{', at), end = text.find(';', at);
      const std::string head = trimmed(std::string_view(text).substr(at, std::min(open, end) - at));
      const bool is_at_rule = head.starts_with("@");
      if (is_at_rule && end < open) {  // such as @import, which would read other files
        at = end + 1;
        has_others = true;
        continue;
      }
      if (open == std::string::npos) return;
      size_t close = open + 1;
      for (int depth = 1; close < text.size(); ++close) {
        depth += text[close] == '{' ? 1 : text[close] == '}' ? -1 : 0;
        if (depth == 0) break;
      }
      const std::string block = text.substr(open + 1, close - open - 1);
      at = close + 1;
      if (is_at_rule) {
        if (head == "@font-face")
          at_rules += head + "{" + block + "}\n";
        else
          has_others = true;
        continue;
      }
      const Declarations declarations = declarations_of(trimmed(std::string_view(block)));
      for (const std::string& selector : parts_of(head, ',')) {
        if (auto supported = selector_of(selector))
          rules.push_back({std::move(*supported), declarations});
        else
          has_others = true;
      }
    }
  }
};

/// All elements of a tree, without recursion.
template <class Visit>
void for_each_element(const pugi::xml_node& root, const Visit& visit) {
  for (pugi::xml_node node = root; node;) {
    if (node.type() == pugi::node_element) visit(node);
    pugi::xml_node next = node.first_child();
    while (!next && node && node != root) {
      next = node.next_sibling();
      if (!next) node = node.parent();
    }
    node = next;
  }
}

}  // namespace

bool inline_style_sheets(pugi::xml_node root, const std::string& name) {
  constexpr double kMostTests = 5e7;
  Sheets sheets;
  std::vector<pugi::xml_node> elements, styles;
  for_each_element(root, [&](const pugi::xml_node& node) {
    elements.push_back(node);
    if (local_name(node) == "style") styles.push_back(node);
  });
  std::erase_if(elements, [](const pugi::xml_node& node) { return local_name(node) == "style"; });
  for (pugi::xml_node style : styles) {
    std::string text;
    for (const pugi::xml_node& part : style.children()) text += part.value();
    sheets.add(without_comments(text));
    style.parent().remove_child(style);
  }
  if (!sheets.at_rules.empty())
    root.prepend_child("style").append_child(pugi::node_pcdata).set_value(sheets.at_rules.c_str());
  if (static_cast<double>(sheets.rules.size()) * static_cast<double>(elements.size()) > kMostTests)
    throw Error(ErrorKind::bad_input, name + ": the drawing has too many style rules");
  std::ranges::stable_sort(sheets.rules, {}, &Rule::specificity);
  for (pugi::xml_node node : elements) {
    Declarations all, important;
    const auto add = [&](const Declarations& more) {
      constexpr std::string_view kImportant = "!important";
      for (const auto& [property, value] : more)
        if (value.ends_with(kImportant))
          set(important, property,
              trimmed(std::string_view(value).substr(0, value.size() - kImportant.size())));
        else
          set(all, property, value);
    };
    bool is_selected = false;
    for (const Rule& rule : sheets.rules)
      if (selects(rule.selector, node)) {
        add(rule.declarations);
        is_selected = true;
      }
    if (!is_selected) continue;
    add(declarations_of(node.attribute("style").as_string()));
    for (const auto& [property, value] : important) set(all, property, value);
    if (!node.attribute("style")) node.append_attribute("style");
    node.attribute("style").set_value(text_of(all).c_str());
  }
  return sheets.has_others;
}

std::string property_of(const pugi::xml_node& node, const std::string& name) {
  if (const pugi::xml_attribute style = node.attribute("style"))
    for (const auto& [property, value] : declarations_of(style.as_string()))
      if (property == name) return value;
  return trimmed(node.attribute(name.c_str()).as_string());
}

std::string inherited_property(pugi::xml_node node, const std::string& name) {
  for (; node.type() == pugi::node_element; node = node.parent())
    if (std::string value = property_of(node, name); !value.empty() && value != "inherit")
      return value;
  return "";
}

void set_property(pugi::xml_node node, const std::string& name, const std::string& value) {
  Declarations all = declarations_of(node.attribute("style").as_string());
  std::erase_if(all, [&](const auto& declaration) { return declaration.first == name; });
  if (!value.empty()) all.emplace_back(name, value);
  node.remove_attribute(name.c_str());
  node.remove_attribute("style");
  if (!all.empty()) node.append_attribute("style").set_value(text_of(all).c_str());
}

std::string id_in_url(const std::string& value) {
  if (!value.starts_with("url(")) return "";
  const size_t close = value.find(')');
  std::string inside =
      trimmed(std::string_view(value).substr(4, close == std::string::npos ? close : close - 4));
  std::erase_if(inside, [](char c) { return c == '"' || c == '\''; });
  return inside.starts_with("#") ? inside.substr(1) : "";
}

std::string local_name(const pugi::xml_node& node) {
  const std::string name = node.name();
  const size_t colon = name.find(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

}  // namespace holomorph
