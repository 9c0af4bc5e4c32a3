// SPDX-License-Identifier: MIT
#include "relucent/base/zip_file.h"

#include <fmt/format.h>
#include <zip.h>

#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

Error cannotWrite(const fs::path& path, const std::string& reason) {
  return {ErrorKind::disk, RELUCENT_MESSAGE("disk.cannot-write", "cannot write ({})").with(reason),
          RELUCENT_ENGLISH_MESSAGE("disk.check-space-and-permission",
                                   "check that the disk has room and that you may write there"),
          path.string()};
}

}  // namespace

void writeZip(const fs::path& path, const ZipEntries& entries) {
  writeFileAtomically(path, [&](const fs::path& temporary) {
    int code = 0;
    zip_t* archive = zip_open(temporary.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (archive == nullptr) throw cannotWrite(path, fmt::format("libzip says {}", code));
    auto giveUp = [&] {
      Error failure = cannotWrite(path, zip_strerror(archive));
      zip_discard(archive);
      throw failure;
    };
    for (const auto& [name, content] : entries) {
      zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
      if (source == nullptr) giveUp();
      zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
      if (index < 0) {
        zip_source_free(source);
        giveUp();
      }
      // The first of January 1980.
      if (zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, 0x21, 0) != 0) giveUp();
    }
    if (zip_close(archive) != 0) giveUp();
  });
}

}  // namespace relucent
