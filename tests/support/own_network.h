// SPDX-License-Identifier: MIT
#pragma once

namespace relucent::test {

/// A loopback network for this process alone where the system allows it; elsewhere waits until no other test
/// is on the machine's. To be called before any thread is started.
/// The port of GigE Vision is fixed, and two cameras on one loopback would answer each other's program.
void enterOwnNetwork();

}  // namespace relucent::test
