// The editor on a recorded screen, driven through standard input and output: each line is a list of
// events as JSON, and is answered by the editor's state, when the editor waits for more.
//
//   recorded_editor WIDTH HEIGHT [--allow-outside] [FILE]
//
//   ["move", X, Y]  ["button", N, DOWN]  ["scroll", LINES]  ["key", CODE, ACTION, MODS]
//   ["character", CODE]  ["drop", FILE]  ["close"]  ["pass", SECONDS]
#include <iostream>
#include <string>
#include <vector>

#include "core/error.h"
#include "editor_state.h"
#include "recorded_screen.h"

using namespace holomorph;

namespace {

void send(const nlohmann::json& event, RecordedScreen& screen) {
  const std::string what = event[0];
  if (what == "move")
    screen.move(event[1], event[2]);
  else if (what == "button")
    screen.button(event[1], event[2]);
  else if (what == "scroll")
    screen.scroll(event[1]);
  else if (what == "key")
    screen.key(event[1], event[2], event[3]);
  else if (what == "character")
    screen.character(event[1]);
  else if (what == "drop")
    screen.drop(event[1].get<std::string>());
  else if (what == "close")
    screen.close();
  else
    check(what == "pass", "a known event");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  EditorOptions options;
  for (size_t i = 2; i < words.size(); ++i) {
    if (words[i] == "--allow-outside")
      options.allow_outside = true;
    else
      options.file = words[i];
  }
  try {
    Preferences preferences = load_preferences();
    RecordedScreen screen(std::stoi(words.at(0)), std::stoi(words.at(1)), preferences);
    Editor editor(screen, std::move(preferences), options);
    bool runs = true;
    const auto answer = [&](const std::string& line) {
      double seconds = 0;
      for (const nlohmann::json& event : nlohmann::json::parse(line)) {
        if (event[0] == "pass") seconds += event[1].get<double>();
        send(event, screen);
      }
      screen.let_pass(seconds);
      while (runs && !screen.idle()) runs = editor.step();
      constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
      std::cout << EditorState(editor).json().dump(-1, ' ', false, kReplace) << std::endl;
    };
    answer("[]");
    for (std::string line; runs && std::getline(std::cin, line);) answer(line);
  } catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
