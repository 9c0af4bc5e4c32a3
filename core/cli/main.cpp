// SPDX-License-Identifier: MIT
#include "cli/commands.h"

int main(int argc, char** argv) {
  return relucent::runCommandLine({argv + 1, argv + argc});
}
