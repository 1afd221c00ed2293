// The command formats, which lists what files can be.
#pragma once

namespace holomorph {

struct FormatsCommand {
  bool markdown = false;
};
/// Prints which files can be opened and written.
void run(const FormatsCommand& command);

}  // namespace holomorph
