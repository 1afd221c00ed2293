// Where the running program is, and the files that are installed with it.
#pragma once

#include "system/file.h"

namespace holomorph {

/// The file of the running program; empty if the system does not tell.
Path program_file();

/// The file or folder share/holomorph/NAME next to the folder of the program, where an installed
/// program has its data. If there is none, `built`, where it was when the program was built.
Path data_file(const std::string& name, const Path& built);

}  // namespace holomorph
