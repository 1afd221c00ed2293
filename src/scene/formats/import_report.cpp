#include "scene/formats/import_report.h"

#include <algorithm>

namespace holomorph {

std::string ImportReport::text(size_t most) const {
  std::string lines;
  const size_t shown = std::min(most, notes.size());
  for (size_t i = 0; i < shown; ++i)
    lines += (i > 0 ? "\n" : "") + (notes[i].layer.empty() ? file : notes[i].layer) + ": " +
             notes[i].text;
  if (const size_t more = notes.size() - shown; more > 0)
    lines += "\nand " + std::to_string(more) + " more";
  return lines;
}

}  // namespace holomorph
