// What is said of bad input.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "core/error.h"

namespace holomorph {

/// The message of the Error{bad_input} that an act ends with; empty without one.
template <class Act>
std::string complaint_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::bad_input);
    return error.what();
  }
  return "";
}

}  // namespace holomorph
