// Runs the function of a fuzz target without a fuzzer, on given files and on the files in given
// folders. Use it to replay corpora or to run under a memory checker. `--mutate N SEED` also runs
// it on N mutations of these files.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size);
/// What a target does to mutated inputs, such as repairing their checksums.
extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most,
                                          unsigned int seed) __attribute__((weak));
extern "C" size_t LLVMFuzzerMutate(std::uint8_t*, size_t size, size_t) {
  return size;
}

namespace {

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string mutated(std::string bytes, const std::string& other, std::mt19937_64& random) {
  const auto below = [&](size_t n) { return n == 0 ? 0 : random() % n; };
  for (size_t changes = 1 + below(5); changes > 0; --changes) {
    const size_t at = below(bytes.size()), length = below(std::min<size_t>(bytes.size() - at, 64));
    switch (below(6)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.replace(at, length, other.substr(below(other.size() + 1), below(64)));
        break;
      default:
        for (size_t k = 0; k < 4 && at + k < bytes.size(); ++k)
          bytes[at + k] = static_cast<char>(below(2) ? 0xff : 0x7f);
    }
  }
  if (LLVMFuzzerCustomMutator)
    LLVMFuzzerCustomMutator(reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size(),
                            bytes.size(), static_cast<unsigned>(random()));
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> inputs;
  size_t made = 0;
  unsigned long seed = 1;
  const auto add = [&](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  };
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--mutate") == 0 && i + 2 < argc) {
      made = std::strtoul(argv[i + 1], nullptr, 10);
      seed = std::strtoul(argv[i + 2], nullptr, 10);
      i += 2;
    } else if (std::filesystem::is_directory(argv[i])) {
      for (const auto& entry : std::filesystem::directory_iterator(argv[i])) add(entry.path());
    } else {
      add(argv[i]);
    }
  }
  for (const std::string& input : inputs) run(input);
  std::mt19937_64 random(seed);
  for (size_t k = 0; k < made && !inputs.empty(); ++k)
    run(mutated(inputs[random() % inputs.size()], inputs[random() % inputs.size()], random));
  std::printf("%zu files and %zu mutations of them, seed %lu\n", inputs.size(), made, seed);
}
