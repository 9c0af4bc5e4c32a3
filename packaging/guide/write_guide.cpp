// SPDX-License-Identifier: MIT
// write-guide HELP FOLDER: the user's guide, HELP/LANGUAGE/*.md, as HTML in FOLDER.
#include <QGuiApplication>
#include <cstdio>
#include <exception>

#include "guide/guide_html.h"

int main(int argc, char** argv) {
  // Without a font the text has no looks; it needs none.
  QGuiApplication application(argc, argv);
  if (argc != 3) {
    std::fprintf(stderr, "usage: write-guide HELP FOLDER\n");
    return 2;
  }
  try {
    relucent::gui::writeGuide(QString::fromLocal8Bit(argv[1]), QString::fromLocal8Bit(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write-guide: %s\n", error.what());
    return 1;
  }
  return 0;
}
