#include "system/program.h"

namespace holomorph {

Path program_file() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

Path data_file(const std::string& name, const Path& built) {
  const Path program = program_file();
  if (program.empty()) return built;
  const Path installed = program.parent_path().parent_path() / "share/holomorph" / name;
  return path_exists(installed) ? installed : built;
}

}  // namespace holomorph
