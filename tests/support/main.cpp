// The test runner's main, compiled once, and a listener that notes the processor time of each case.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Listener = Catch::EventListenerBase;
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
using Listener = Catch::TestEventListenerBase;
#endif

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

namespace {

/// Appends a line to the file that the environment variable HOLOMORPH_SECONDS names; see
/// measured.py.
class Seconds : public Listener {
 public:
  using Listener::Listener;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    name_ = info.name;
    start_ = std::clock();
  }
  void testCaseEnded(const Catch::TestCaseStats&) override {
    const double seconds = static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
    if (const char* path = std::getenv("HOLOMORPH_SECONDS"))
      std::ofstream(path, std::ios::app) << seconds << '\t' << name_ << '\n';
  }

 private:
  std::string name_;
  std::clock_t start_ = 0;
};

CATCH_REGISTER_LISTENER(Seconds)

}  // namespace

int main(int count, char** words) {
  return Catch::Session().run(count, words);
}
