// Catch2, version 2 (Debian 12) or 3 (Debian 13 and later), by the names of version 2.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>

namespace Catch {
using Matchers::Equals;
using Matchers::StartsWith;
using Matchers::WithinAbs;

/// Version 3 calls this ContainsSubstring, and uses the name for ranges.
inline auto Contains(const std::string& part) {
  return Matchers::ContainsSubstring(part);
}
}  // namespace Catch
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
