// SPDX-License-Identifier: MIT
#include "relucent/base/scratch_file.h"

#include "relucent/base/error.h"
#include "relucent/platform/files.h"
#include "relucent/platform/unnamed_file.h"

namespace relucent {
namespace {

void requireDone(const std::error_code& code) {
  if (!code) return;
  throw Error(ErrorKind::disk,
              RELUCENT_MESSAGE("disk.no-scratch-room", "there is no room for intermediate results ({})")
                  .with(code.message()),
              platform::isDiskFull(code)
                  ? RELUCENT_MESSAGE("disk.free-scratch-room",
                                     "free some space there; what has been photographed is safe")
                  : RELUCENT_MESSAGE("disk.choose-scratch-folder",
                                     "let the environment variable TMPDIR name a folder on a disk that you "
                                     "may write to; what has been photographed is safe"),
              platform::scratchFolder().string());
}

}  // namespace

ScratchFile::ScratchFile() : file_(std::make_unique<platform::UnnamedFile>(platform::scratchFolder())) {
  requireDone(file_->error());
}

ScratchFile::~ScratchFile() = default;
ScratchFile::ScratchFile(ScratchFile&&) noexcept = default;
ScratchFile& ScratchFile::operator=(ScratchFile&&) noexcept = default;

void ScratchFile::writeBytes(std::uint64_t at, std::span<const std::byte> bytes) {
  requireDone(file_->write(at, bytes));
}

void ScratchFile::readBytes(std::uint64_t at, std::span<std::byte> bytes) const {
  requireDone(file_->read(at, bytes));
}

}  // namespace relucent
