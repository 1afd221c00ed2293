// The test runner's main, compiled once, and a listener that notes the processor time of each case.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Listener = Catch::EventListenerBase;
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
using Listener = Catch::TestEventListenerBase;
#endif

#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace {

/// The processor time of this process and of those that it started, in seconds.
double used() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

/// Appends a line to the file that the environment variable HOLOMORPH_SECONDS names; see
/// measured.py.
class Seconds : public Listener {
 public:
  using Listener::Listener;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    name_ = info.name;
    start_ = used();
  }
  void testCaseEnded(const Catch::TestCaseStats&) override {
    const double seconds = used() - start_;
    if (const char* path = std::getenv("HOLOMORPH_SECONDS"))
      std::ofstream(path, std::ios::app) << seconds << '\t' << name_ << '\n';
  }

 private:
  std::string name_;
  double start_ = 0;
};

CATCH_REGISTER_LISTENER(Seconds)

}  // namespace

int main(int count, char** words) {
  return Catch::Session().run(count, words);
}
