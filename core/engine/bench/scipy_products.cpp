// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "relucent/base/error.h"
#include "relucent/engine/bench/reference_products.h"
#include "relucent/engine/bench/scripts.h"

namespace relucent::engine {
namespace {

/// A folder among the system's temporary files, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "relucent-bench-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) fail();
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void write(const char* name, const void* data, std::size_t bytes) const {
    std::ofstream file(path_ / name, std::ios::binary);
    file.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    if (!file.flush()) fail();
  }

 private:
  [[noreturn]] static void fail() {
    throw Error(ErrorKind::disk,
                RELUCENT_ENGLISH_MESSAGE("engine.cannot-write-operator",
                                         "an operator could not be written for SciPy"),
                RELUCENT_ENGLISH_MESSAGE("engine.free-temporary-space",
                                         "make room among the temporary files, or time without references"));
  }
  std::filesystem::path path_;
};

template <typename Value>
void writeArray(const Folder& folder, const char* name, const Value* values, Eigen::Index count) {
  folder.write(name, values, sizeof(Value) * static_cast<std::size_t>(count));
}

/// What a command prints; empty if it fails.
std::string outputOf(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  char part[256];
  while (std::fgets(part, sizeof part, pipe) != nullptr) text += part;
  return pclose(pipe) == 0 ? text : std::string();
}

}  // namespace

std::optional<EngineBenchTiming> timeSciPy(const ReferencePlane& plane, ReferenceProduct product,
                                           bool oneThread) {
  const Folder folder;
  writeArray(folder, "start", plane.outerIndexPtr(), plane.rows() + 1);
  writeArray(folder, "column", plane.innerIndexPtr(), plane.nonZeros());
  writeArray(folder, "value", plane.valuePtr(), plane.nonZeros());
  const std::string shape = fmt::format("{} {}\n", plane.rows(), plane.cols());
  folder.write("shape", shape.data(), shape.size());
  folder.write("products.py", scripts::scipy_products.data(), scripts::scipy_products.size());

  // The first python3 of the path need not be the system's, for which SciPy is packaged.
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const std::string printed = outputOf(
        fmt::format("{} '{}' '{}' {} {} 2>/dev/null", python, (folder.path() / "products.py").string(),
                    folder.path().string(), product == ReferenceProduct::both ? "both" : "there",
                    oneThread ? "thread" : "wall"));
    EngineBenchTiming timing;
    if (std::sscanf(printed.c_str(), "%lf %lf", &timing.median, &timing.best) == 2) return timing;
  }
  return std::nullopt;
}

}  // namespace relucent::engine
