// The inspector's section about the film that is the edited layer's picture.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Whether the edited layer's picture is a film, or one of several numbered pictures.
bool has_film(const Workspace& workspace);
void film_section(Workspace& workspace);

}  // namespace holomorph
