// Other programs: their output comes back complete, and none of them can block the caller.
#include "system/process.h"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/clock.h"
#include "support/catch.h"
#include "system/watched_program.h"

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
  CHECK_FALSE(run_program({"sleep", "60"}, "", {.keep_running = [&] { return ++asked < 3; }}));
  CHECK(now_ms() - start < 30000);
  asked = 0;
  CHECK_FALSE(run_program({"sh", "-c", "trap '' TERM; exec >&- 2>&- <&-; sleep 60"}, "",
                          {.keep_running = [&] { return ++asked < 5; }}));
  CHECK(now_ms() - start < 30000);
  CHECK_FALSE(run_program({"cat", "/dev/zero"}, "", {.most_output = 1 << 20}));
}

TEST_CASE("A program is limited in processor time and memory") {
  const auto endless =
      run_program({"sh", "-c", "while :; do :; done"}, "", {.limits = {.seconds = 1}});
  REQUIRE(endless);
  CHECK(endless->out_of_time);
  CHECK(endless->status != 0);
  const auto hungry = run_program({"perl", "-e", "my $x = 'a' x 400_000_000; print length $x"}, "",
                                  {.limits = {.bytes = 100e6}});
  REQUIRE(hungry);
  CHECK_FALSE(hungry->out_of_time);
  CHECK(hungry->output.empty());
  // The time of a running program can be extended.
  const auto child = start_program({"sh", "-c", "while :; do :; done"});
  REQUIRE(child);
  const double start = now_ms();
  int status = 0;
  while (now_ms() - start < 2500 && ::waitpid(child->pid, &status, WNOHANG) == 0) {
    limit_program(child->pid, {.seconds = 2});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  CHECK(::waitpid(child->pid, &status, WNOHANG) == 0);
  ::waitpid(child->pid, &status, 0);
  CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU));
  ::close(child->socket);
}

TEST_CASE("A program that makes no progress is ended, and one that works is not") {
  const double start = now_ms();
  WatchedProgram stuck({"sleep", "60"}, "");
  const std::string input(1 << 16, 'x');
  while (stuck.accepts(200))
    ::send(stuck.socket(), input.data(), input.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  CHECK(stuck.was_stuck());
  CHECK(stuck.end() != 0);
  WatchedProgram silent({"sleep", "60"}, "");
  CHECK(silent.accepts(200));
  CHECK(silent.end(200) != 0);
  CHECK(silent.was_stuck());
  CHECK(now_ms() - start < 30000);
  WatchedProgram busy({"perl", "-e", "1 while times < 1"}, "");
  CHECK(busy.end(500) == 0);
  CHECK_FALSE(busy.was_stuck());
}

TEST_CASE("The caller does not wait for a helper that a program leaves behind") {
  const double start = now_ms();
  const auto finished = run_program({"sh", "-c", "echo here; sleep 60 & exit 0"});
  REQUIRE(finished);
  CHECK(finished->output == "here\n");
  CHECK(now_ms() - start < 30000);
}

}  // namespace holomorph::process_test
