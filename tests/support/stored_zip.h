// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relucent::test {

/// Names and contents.
using ZipMembers = std::vector<std::pair<std::string, std::string>>;

/// A zip archive of members that are not compressed, in this order, equal names and all.
std::string storedZip(const ZipMembers& members);
/// The members of an archive of such. Contract: it is one.
ZipMembers zipMembers(std::string_view archive);

}  // namespace relucent::test
