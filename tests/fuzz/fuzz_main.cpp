// SPDX-License-Identifier: MIT
// One target as a program of libFuzzer's: RELUCENT_FUZZ_TARGET names it; without, the program lists all.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "fuzz/mutation.h"

using namespace relucent;
using namespace relucent::fuzz;

namespace {

const FuzzTarget* target = nullptr;

const FuzzTarget* wantedTarget() {
  const char* wanted = std::getenv("RELUCENT_FUZZ_TARGET");
  for (const FuzzTarget& each : allTargets())
    if (wanted != nullptr && std::string_view(each.name) == wanted) return &each;
  for (const FuzzTarget& each : allTargets()) std::printf("%s\n", each.name);
  std::exit(2);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  target = wantedTarget();
  // A folder for the seeds, to be named on the command line as libFuzzer's corpus.
  if (const char* folder = std::getenv("RELUCENT_FUZZ_SEEDS")) {
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const std::string& seed : target->seeds())
      std::ofstream(std::filesystem::path(folder) / std::to_string(number++), std::ios::binary) << seed;
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  static const Mutator mutator(*target);
  Random random{seed};
  if (random.below(2) == 0) return LLVMFuzzerMutate(data, size, most);
  const std::string changed = mutator.changed({reinterpret_cast<const char*>(data), size}, random);
  const std::size_t length = std::min(most, changed.size());
  std::copy_n(changed.begin(), length, reinterpret_cast<char*>(data));
  return length;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string finding = findingOf(*target, std::as_bytes(std::span(data, size)));
  if (finding.empty()) return 0;
  std::fprintf(stderr, "%s: %s\n", target->name, finding.c_str());
  std::abort();
}
