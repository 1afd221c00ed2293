// THE table of methods.
#include "core/deformer.h"
#include "core/error.h"
#include "core/methods/rows.h"

namespace holomorph {

const std::vector<Method>& methods() {
  static const std::vector<Method> table{cage_method(), pins_method()};
  return table;
}

const Method& method_named(const std::string& id) {
  std::string known;
  for (const Method& method : methods()) {
    if (method.id == id) return method;
    known += (known.empty() ? "" : ", ") + method.id;
  }
  throw Error(ErrorKind::bad_input,
              "method '" + id + "' is not available in this version; choose one of: " + known);
}

double parameter(const Method& method, const Parameters& values, const std::string& key) {
  if (const auto found = values.find(key); found != values.end()) return found->second;
  for (const ParameterSpec& spec : method.parameters)
    if (spec.key == key) return spec.fallback;
  check(false, "a method asks for a parameter that its row names");
  return 0;
}

}  // namespace holomorph
