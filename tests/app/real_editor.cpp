// The editor in its real window, which writes its state into a file whenever it changes, for the
// tests that drive it with real input events.
//
//   real_editor [--allow-outside] [FILE] --state STATE
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "app/window.h"
#include "core/error.h"
#include "editor_state.h"
#include "system/new_file.h"

using namespace holomorph;

int main(int argc, char** argv) {
  EditorOptions options;
  Path state_file;
  const std::vector<std::string> words(argv + 1, argv + argc);
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--state" && i + 1 < words.size())
      state_file = words[++i];
    else if (words[i] == "--allow-outside")
      options.allow_outside = true;
    else
      options.file = words[i];
  }
  try {
    Preferences preferences = load_preferences();
    Window window(1280, 800, preferences);
    Editor editor(window, std::move(preferences), options);
    std::string written;
    while (editor.step()) {
      const std::string text =
          EditorState(editor).json().dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
      if (text == written || state_file.empty()) continue;
      written = text;
      try {
        write_file(state_file, written + "\n");
      } catch (const Error&) {
        // The script that reads the file notices that it is missing.
      }
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
