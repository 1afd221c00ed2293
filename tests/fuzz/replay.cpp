// Runs the functions of fuzz targets without a fuzzer.
//
//   replay [--mutate N SEED] --corpus FOLDER       each target on the files of its folder there
//   replay [--mutate N SEED] TARGET FILES...       one target on files and on the files in folders
//
// With --mutate, each target also runs on N mutations of its files.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using Data = std::uint8_t;
#define TARGET(name) extern "C" int fuzz_##name(const Data* data, size_t size);
TARGET(scene)
TARGET(mesh)
TARGET(surface)
TARGET(picture)
TARGET(drawing)
TARGET(material)
TARGET(settings)
TARGET(autosave)
#undef TARGET
/// What this target does to mutated inputs: it repairs their checksums.
extern "C" size_t mutate_picture(Data* data, size_t size, size_t most, unsigned int seed);
extern "C" size_t LLVMFuzzerMutate(Data*, size_t size, size_t) {
  return size;
}

namespace {

struct Target {
  std::string name;
  int (*run)(const Data*, size_t);
  size_t (*mutate)(Data*, size_t, size_t, unsigned) = nullptr;
};
const std::vector<Target> kTargets{
    {"scene", fuzz_scene},       {"mesh", fuzz_mesh},
    {"surface", fuzz_surface},   {"picture", fuzz_picture, mutate_picture},
    {"drawing", fuzz_drawing},   {"material", fuzz_material},
    {"settings", fuzz_settings}, {"autosave", fuzz_autosave}};

struct Mutations {
  size_t count = 0;
  unsigned long seed = 1;
};

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
  return bytes;
}

void run_on(const Target& target, const std::vector<std::filesystem::path>& paths,
            const Mutations& mutations) {
  std::vector<std::string> inputs;
  const auto add = [&](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  };
  for (const auto& path : paths) {
    if (!std::filesystem::is_directory(path)) {
      add(path);
      continue;
    }
    std::vector<std::filesystem::path> entries;
    for (const auto& entry : std::filesystem::directory_iterator(path))
      entries.push_back(entry.path());
    std::ranges::sort(entries);  // so that a seed gives the same mutations on each machine
    for (const auto& entry : entries) add(entry);
  }
  for (std::string& input : inputs) target.run(reinterpret_cast<Data*>(input.data()), input.size());
  std::mt19937_64 random(mutations.seed);
  for (size_t k = 0; k < mutations.count && !inputs.empty(); ++k) {
    const std::string& input = inputs[random() % inputs.size()];
    std::string bytes = mutated(input, inputs[random() % inputs.size()], random);
    const auto data = reinterpret_cast<Data*>(bytes.data());
    if (target.mutate)
      target.mutate(data, bytes.size(), bytes.size(), static_cast<unsigned>(random()));
    target.run(data, bytes.size());
  }
  std::printf("%s: %zu files and %zu mutations of them, seed %lu\n", target.name.c_str(),
              inputs.size(), mutations.count, mutations.seed);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  Mutations mutations;
  size_t at = 0;
  if (words.size() >= 3 && words[0] == "--mutate") {
    mutations = {std::stoul(words[1]), std::stoul(words[2])};
    at = 3;
  }
  if (words.size() >= at + 2 && words[at] == "--corpus") {
    for (const Target& target : kTargets)
      run_on(target, {std::filesystem::path(words[at + 1]) / target.name}, mutations);
    return 0;
  }
  for (const Target& target : kTargets)
    if (words.size() > at + 1 && target.name == words[at]) {
      run_on(target, {words.begin() + static_cast<std::ptrdiff_t>(at) + 1, words.end()}, mutations);
      return 0;
    }
  std::fputs(
      "usage: replay [--mutate N SEED] --corpus FOLDER | replay [--mutate N SEED] TARGET "
      "FILES...\n",
      stderr);
  return 2;
}
