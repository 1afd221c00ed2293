// Reads any bytes as an autosave through the file system: it is listed, recovered and written
// again.
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "scene/document.h"
#include "scene/recovery.h"

using namespace holomorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const Path folder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "holomorph-fuzz-XXXXXX").string();
    return Path(::mkdtemp(name.data()));
  }();
  const Path file = folder / "autosave.json";
  std::FILE* out = std::fopen(file.c_str(), "wb");
  std::fwrite(data, 1, size, out);
  std::fclose(out);
  check(recoverable(folder).size() == 1, "an existing autosave is offered");
  try {
    Document document = Document::recover(file);
    discard(file);
    check(!document.autosave(folder) || document.scene() == Scene{} || recoverable(folder).empty(),
          "its own autosave is in use");
    document.remove_autosave(folder);
  } catch (const Error&) {
  }
  return 0;
}
