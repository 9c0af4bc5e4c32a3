// SPDX-License-Identifier: MIT
#include "relucent/cli/commands.h"

int main(int argc, char** argv) {
  return relucent::cli::runCommandLine({argv + 1, argv + argc});
}
