// Reads and writes scenes as JSON text. The format is published in schema/scene.schema.json.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// Reads a scene. `name` is the file's name, used in messages. Throws Error{bad_input} with the
/// file, the JSON pointer and the reason. Possible reasons include text that is not JSON, a wrong
/// type, a number that is not finite or exceeds 1e8, a newer version, an unknown method, and an
/// invalid rest cage. Unknown keys are kept.
Scene scene_from_json(const std::string& text, const std::string& name);

/// Throws Error{bad_input} for names that cannot be written to a file: not UTF-8, or empty.
void check_texts(const Layer& layer);

/// Writes a scene, including its unknown keys. Reading the text back produces the same scene, bit
/// for bit.
std::string json_of(const Scene& scene);

}  // namespace holomorph
