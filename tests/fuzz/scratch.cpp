// SPDX-License-Identifier: MIT
#include "fuzz/scratch.h"

#include <unistd.h>

#include <stdexcept>
#include <string>

#include "relucent/platform/files.h"

namespace relucent::fuzz {
namespace fs = std::filesystem;
namespace {

class Folder {
 public:
  Folder()
      : path_((::access("/dev/shm", W_OK) == 0 ? fs::path("/dev/shm") : fs::temp_directory_path()) /
              ("relucent-fuzz-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

const fs::path& scratch() {
  static const Folder folder;
  return folder.path();
}

fs::path scratchFile(const fs::path& name, std::string_view content) {
  fs::path path = scratch() / name;
  if (platform::writeContent(path, content).code) throw std::runtime_error("cannot write " + path.string());
  return path;
}

}  // namespace relucent::fuzz
