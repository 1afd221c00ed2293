// Other programs: their output comes back complete, and none of them can block the caller.
#include "system/process.h"
#include "support/catch.h"

#include "core/clock.h"

namespace holomorph::process_test {

TEST_CASE("A program gets all of its input, and its output comes back complete") {
  std::string input;
  for (int i = 0; i < 300000; ++i)
    input += static_cast<char>(i * 7);  // more than a socket can buffer
  const auto finished = run_program({"cat"}, input);
  REQUIRE(finished);
  CHECK(finished->status == 0);
  CHECK(finished->output == input);
  CHECK(run_program({"sh", "-c", "exit 3"})->status == 3);
  CHECK(run_program({"true"}, input)->status == 0);  // it does not read its input
}

TEST_CASE("A program that is missing, does not end or writes too much gives no result") {
  CHECK_FALSE(has_program("no-such-program-anywhere"));
  CHECK(has_program("sh"));
  CHECK_FALSE(run_program({"no-such-program-anywhere"}));
  const double start = now_ms();
  int asked = 0;
  CHECK_FALSE(run_program({"sleep", "60"}, "", [&] { return ++asked < 3; }));
  CHECK(now_ms() - start < 30000);
  asked = 0;
  CHECK_FALSE(run_program({"sh", "-c", "trap '' TERM; exec >&- 2>&- <&-; sleep 60"}, "",
                          [&] { return ++asked < 5; }));
  CHECK(now_ms() - start < 30000);
  CHECK_FALSE(run_program(
      {"cat", "/dev/zero"}, "", [] { return true; }, 1 << 20));
}

TEST_CASE("The caller does not wait for a helper that a program leaves behind") {
  const double start = now_ms();
  const auto finished = run_program({"sh", "-c", "echo here; sleep 60 & exit 0"});
  REQUIRE(finished);
  CHECK(finished->output == "here\n");
  CHECK(now_ms() - start < 30000);
}

}  // namespace holomorph::process_test
