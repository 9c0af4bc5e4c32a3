// SPDX-License-Identifier: MIT
#include <QtTest>
#include <set>

#include "relucent/base/fingerprint.h"

using namespace relucent;

class TestFingerprint : public QObject {
  Q_OBJECT

 private slots:
  void equalInputsGiveEqualFingerprints() {
    auto make = [] {
      Fingerprint fingerprint;
      return fingerprint.add("settings").add(3).add(0.5).add(std::vector<float>{1.0f, 2.0f}).hex();
    };
    QCOMPARE(make(), make());
    QCOMPARE(make().size(), std::size_t{32});
    QCOMPARE(make().find_first_not_of("0123456789abcdef"), std::string::npos);
  }

  void itNeverChangesBetweenVersions() {
    // Kept on disk with every result: another algorithm would make all of them stale.
    Fingerprint fingerprint;
    fingerprint.add("relucent").add(42);
    QCOMPARE(QString::fromStdString(fingerprint.hex()), QString("1b3484321dd38c7d8ded4ae1a901e590"));
  }

  void everyDifferenceShows() {
    std::set<std::string> seen;
    auto note = [&](const auto& fill) {
      Fingerprint fingerprint;
      fill(fingerprint);
      seen.insert(fingerprint.hex());
    };
    note([](Fingerprint&) {});
    note([](Fingerprint& f) { f.add(""); });
    note([](Fingerprint& f) { f.add("ab").add("c"); });
    note([](Fingerprint& f) { f.add("a").add("bc"); });
    note([](Fingerprint& f) { f.add("abc"); });
    note([](Fingerprint& f) { f.add(std::vector<float>{1.0f, 2.0f}); });
    note([](Fingerprint& f) { f.add(std::vector<float>{2.0f, 1.0f}); });
    note([](Fingerprint& f) { f.add(std::vector<float>{1.0f}).add(std::vector<float>{2.0f}); });
    note([](Fingerprint& f) { f.add(0.0); });
    note([](Fingerprint& f) { f.add(-0.0); });
    note([](Fingerprint& f) { f.add(1); });
    note([](Fingerprint& f) { f.add(std::int64_t{1}); });
    QCOMPARE(seen.size(), std::size_t{12});
  }

  void askingDoesNotEndIt() {
    Fingerprint asked, plain;
    asked.add("a");
    asked.hex();
    asked.low();
    QCOMPARE(asked.add("b").hex(), plain.add("a").add("b").hex());
  }

  void theKeyIsItsLowerHalf() {
    Fingerprint fingerprint;
    fingerprint.add("x");
    QCOMPARE(std::stoull(fingerprint.hex().substr(16), nullptr, 16), fingerprint.low());
  }
};

QTEST_APPLESS_MAIN(TestFingerprint)
#include "test_fingerprint.moc"
