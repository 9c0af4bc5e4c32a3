// SPDX-License-Identifier: MIT
#include <QUdpSocket>
#include <QtTest>

#include "relucent/pjlink/search.h"
#include "relucent/platform/broadcast_addresses.h"
#include "support/fake_projector.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::pjlink;

class TestPjlinkSearch : public QObject {
  Q_OBJECT

 private slots:
  void aProjectorIsFoundOnceWhateverElseAnswers() {
    relucent::test::FakeProjector projector;
    projector.beFound();
    Progress quiet;
    SearchSettings settings{std::chrono::milliseconds(1000), {"127.0.0.1"}, projector.address().port};
    const std::vector<Found> found = searchProjectors(settings, quiet);
    QCOMPARE(found.size(), std::size_t{1});
    QCOMPARE(found[0].hardware, std::string("01:23:45:67:89:ab"));
    QCOMPARE(found[0].address.host, std::string("127.0.0.1"));
    QCOMPARE(found[0].address.port, standardPort);
  }

  void nobodyAnswers() {
    QUdpSocket nobody;
    QVERIFY(nobody.bind(QHostAddress::LocalHost, 0));
    Progress quiet;
    QVERIFY(
        searchProjectors({std::chrono::milliseconds(200), {"127.0.0.1"}, nobody.localPort()}, quiet).empty());
  }

  void stoppingEndsASearch() {
    Stopped stopped;
    QVERIFY_EXCEPTION_THROWN(searchProjectors({std::chrono::minutes(5), {"127.0.0.1"}}, stopped), Cancelled);
  }

  void onlyNumbersAreAsked() {
    QVERIFY(problems(SearchSettings()).empty());
    QVERIFY(problems(SearchSettings{{}, {"192.168.1.255"}}).empty());
    for (const char* wrong : {"left", "::1", "1.2.3", ""})
      QCOMPARE(problems(SearchSettings{{}, {wrong}}).size(), std::size_t{1});
  }

  /// Loopback is not among them: nobody is asked there without being named.
  void networksOfThisComputer() {
    for (const std::string& address : platform::broadcastAddresses()) {
      QVERIFY2(problems(SearchSettings{{}, {address}}).empty(), address.c_str());
      QVERIFY2(!address.starts_with("127."), address.c_str());
    }
  }
};

QTEST_GUILESS_MAIN(TestPjlinkSearch)
#include "test_pjlink_search.moc"
