// SPDX-License-Identifier: MIT
#include "relucent/base/fingerprint.h"

#include <fmt/format.h>
#include <xxhash.h>

#include "relucent/base/error.h"

namespace relucent {

struct Fingerprint::State {
  XXH3_state_t* xxh = XXH3_createState();
  ~State() { XXH3_freeState(xxh); }
};

Fingerprint::Fingerprint() : state_(std::make_unique<State>()) {
  require(state_->xxh != nullptr, "no memory for a fingerprint");
  XXH3_128bits_reset(state_->xxh);
}

Fingerprint::~Fingerprint() = default;

Fingerprint& Fingerprint::addBytes(const void* data, std::size_t bytes) {
  std::uint64_t length = bytes;
  XXH3_128bits_update(state_->xxh, &length, sizeof(length));
  XXH3_128bits_update(state_->xxh, data, bytes);
  return *this;
}

std::string Fingerprint::hex() const {
  XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::uint64_t Fingerprint::low() const {
  return XXH3_128bits_digest(state_->xxh).low64;
}

}  // namespace relucent
