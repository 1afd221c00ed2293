// A dialog that asks a question and runs the chosen answer.
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
    bool destroys = false;  ///< work is lost
  };
  std::string title, text;
  std::vector<Answer> answers;
  size_t default_answer = 0;          ///< has the focus, so Enter chooses it; should be harmless
  std::optional<size_t> escape = {};  ///< the answer that Escape chooses; none: the last answer
};

/// Shows one question at a time.
class Questions {
 public:
  /// Opens a question. It replaces the open one, if any.
  void ask(Question question) { open_ = std::move(question); }
  bool open() const { return open_.has_value(); }
  /// The open question's title, or "".
  std::string title() const { return open_ ? open_->title : ""; }
  void withdraw() { open_.reset(); }
  /// Draws the open question. When it is answered, calls the answer's `act`.
  void draw();

 private:
  std::optional<Question> open_;
};

}  // namespace holomorph
