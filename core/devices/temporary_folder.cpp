// SPDX-License-Identifier: MIT
#include "relucent/devices/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "relucent/base/error.h"

namespace relucent::devices {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code code;
  const fs::path parent = fs::temp_directory_path(code);
  std::string name = ((code ? fs::path("/tmp") : parent) / "relucent-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("device.cannot-create-temporary-folder", "cannot create a temporary folder ({})")
            .with(std::strerror(errno)),
        RELUCENT_MESSAGE("device.free-space-or-set-tmpdir",
                         "free some space there, or set TMPDIR to a folder that you may write to"),
        name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace relucent::devices
