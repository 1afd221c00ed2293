// The error messages for bad input.
#pragma once

#include <string>

#include "core/error.h"
#include "support/catch.h"

namespace holomorph {

/// The message of the Error{bad_input} that `act` throws; empty if it throws none.
template <class Act>
std::string error_message_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::bad_input);
    return error.what();
  }
  return "";
}

}  // namespace holomorph
