// A question over the window, and what each answer does.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace holomorph {

struct Question {
  struct Answer {
    std::string label;
    std::function<void()> act;
  };
  std::string title, text;
  std::vector<Answer> answers;
  size_t usual = 0;  ///< the answer that has the focus, and that Enter gives; one that does no harm
  std::optional<size_t> escape = {};  ///< the answer that Escape gives; none: the last one
};

/// Shows one question at a time.
class Questions {
 public:
  /// Takes the place of one that is open.
  void ask(Question question) { open_ = std::move(question); }
  bool open() const { return open_.has_value(); }
  /// The open question's title, or "".
  std::string title() const { return open_ ? open_->title : ""; }
  void withdraw() { open_.reset(); }
  /// Draws it, and acts when it is answered.
  void draw(double scale);

 private:
  std::optional<Question> open_;
};

}  // namespace holomorph
