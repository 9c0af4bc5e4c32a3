// SPDX-License-Identifier: MIT
#include "relucent/image/stack_files.h"

#include <QTemporaryDir>
#include <QtTest>

#include "relucent/image/exr.h"

using namespace relucent;
using namespace relucent::image;

class TestStackFiles : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the files together hold the stack, the same bits, each with its units.
  void everyDeviceHasAFileOfItsPart() {
    QTemporaryDir folder;
    const Rasters rasters({{4, 3}, {2, 5}});
    Stack stack(3 * rasters.count());
    for (std::size_t i = 0; i < stack.size(); ++i) stack[i] = 0.1F * static_cast<float>(i);
    const auto files = writeStack(folder.path().toStdString(), "flood", stack, rasters, "lamps");
    QCOMPARE(files.size(), std::size_t{2});
    std::vector<Image> parts;
    for (std::size_t device = 0; device < files.size(); ++device) {
      QCOMPARE(files[device].filename().string(), stackFileName("flood", device));
      parts.push_back(readRgbExr(files[device], rasters.size(device)));
      QCOMPARE(std::get<std::string>(readExr(files[device]).attributes.at(exr_attribute::units)),
               std::string("lamps"));
    }
    QVERIFY(stackFromImages(parts, rasters) == stack);
    QCOMPARE(stackFileName("flood", 0), std::string("flood-1.exr"));
  }

  void flagsAreZeroOrOneInAllChannels() {
    QVERIFY((stackFromFlags({0, 1, 7}) == Stack{0, 0, 0, 1, 1, 1, 1, 1, 1}));
  }
};

QTEST_GUILESS_MAIN(TestStackFiles)
#include "test_stack_files.moc"
