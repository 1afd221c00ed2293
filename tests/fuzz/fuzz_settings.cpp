// Reads any bytes as preferences, and as keys to import.
#include "core/error.h"
#include "edit/actions/actions.h"
#include "scene/preferences.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Preferences preferences = preferences_of_json(text);
  check(preferences.ui_scale == 0 || (preferences.ui_scale >= 0.75 && preferences.ui_scale <= 4),
        "the scale is in range");
  for (const Path& path : preferences.recent)
    check(path.is_absolute(), "recent files have absolute paths");
  ActionTable actions;
  actions.use_keys(preferences.keys);
  actions.use_keys({});
  try {
    actions.use_keys(keys_of_json(text, "fuzz"));
    actions.use_keys({});
  } catch (const Error&) {
  }
  return 0;
}
