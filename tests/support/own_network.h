// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace relucent::test {

/// Where the machines of enterOwnNetwork() are, from 0 on: each in a subnet of its own, as each camera of
/// GigE Vision listens to its subnet's broadcasts.
std::string ownAddress(int machine);

/// A loopback network for this process alone where the system allows it; elsewhere waits until no other test
/// is on the machine's. To be called before any thread is started.
/// The port of GigE Vision is fixed, and two cameras on one loopback would answer each other's program.
/// `machines`: how many addresses there are to be; elsewhere there is the first one only.
void enterOwnNetwork(int machines = 1);

}  // namespace relucent::test
