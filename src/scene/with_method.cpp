#include "scene/with_method.h"

#include "scene/joined_cage.h"

namespace holomorph {

Deformation with_method(Deformation deformation, const std::string& id) {
  method_named(id);
  if (id == deformation.method) return deformation;
  if (deformation.parameters.empty())
    deformation.other_parameters.erase(deformation.method);
  else
    deformation.other_parameters[deformation.method] = std::move(deformation.parameters);
  deformation.parameters.clear();
  if (auto kept = deformation.other_parameters.extract(id))
    deformation.parameters = std::move(kept.mapped());
  deformation.method = id;
  return method_named(id).allows_parts ? deformation : with_joined_parts(std::move(deformation));
}

}  // namespace holomorph
