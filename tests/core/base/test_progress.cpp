// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/progress.h"
#include "relucent/base/random.h"

using namespace relucent;

namespace {

struct Recorder : ProgressSink {
  std::vector<double> fractions;
  std::vector<std::string> stages;
  std::vector<std::string> previews;
  void progressed(double fraction, const Message& stage) override {
    fractions.push_back(fraction);
    stages.push_back(english(stage));
  }
  void previewed(const Preview& preview) override { previews.push_back(preview.name); }
  bool ascends() const { return std::is_sorted(fractions.begin(), fractions.end()); }
};

/// A job of parts within parts, with shares and reports that nobody planned.
void wander(Progress& progress, Random& random, int depth) {
  const std::uint64_t parts = random.below(4);
  for (std::uint64_t i = 0; i < parts; ++i) {
    progress.report(random.uniform());
    Progress part = progress.part(random.uniform(), Message::plain("depth " + std::to_string(depth)));
    if (depth > 0) wander(part, random, depth - 1);
    if (random.below(2) == 0) part.report(1.0);
  }
}

}  // namespace

class TestProgress : public QObject {
  Q_OBJECT

 private slots:
  void partsMapIntoTheWhole() {
    Recorder sink;
    StopRequest stop;
    Progress whole(sink, stop);
    {
      Progress first = whole.part(0.25, Message::plain("first"));
      first.report(0.5);
      Progress inner = first.part(0.5, Message::plain("inner"));
      inner.report(0.5);
      QCOMPARE(english(inner.stage()), std::string("inner"));
    }
    Progress second = whole.part(0.75, Message::plain("second"));
    second.report(1.0);
    QCOMPARE(sink.fractions, (std::vector<double>{0.0, 0.125, 0.125, 0.1875, 0.25, 1.0}));
    QCOMPARE(sink.stages, (std::vector<std::string>{"first", "first", "inner", "inner", "second", "second"}));
  }

  void itNeverGoesBack_data() {
    QTest::addColumn<int>("seed");
    for (int seed = 0; seed < 20; ++seed) QTest::addRow("seed %d", seed) << seed;
  }
  void itNeverGoesBack() {
    QFETCH(int, seed);
    Recorder sink;
    StopRequest stop;
    Progress whole(sink, stop);
    Random random{static_cast<std::uint64_t>(seed)};
    wander(whole, random, 3);
    whole.report(0.1);
    whole.report(1.0);
    QVERIFY(sink.ascends());
    QVERIFY(sink.fractions.front() >= 0.0);
    QCOMPARE(sink.fractions.back(), 1.0);
  }

  void reportsBeyondTheEndsAreCut() {
    Recorder sink;
    StopRequest stop;
    Progress whole(sink, stop);
    whole.report(-1.0);
    whole.report(0.5);
    whole.report(0.2);
    whole.report(7.0);
    QCOMPARE(sink.fractions, (std::vector<double>{0.0, 0.5, 0.5, 1.0}));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, whole.part(1.5, Message::plain("too much")));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, whole.part(-0.1, Message::plain("too little")));
  }

  void cancellingReachesEveryPart() {
    Recorder sink;
    StopRequest stop;
    Progress whole(sink, stop);
    Progress part = whole.part(0.5, Message::plain("part"));
    Progress inner = part.part(0.5, Message::plain("inner"));
    inner.checkpoint();
    stop.ask(StopRequest::Kind::cancel);
    QVERIFY_THROWS_EXCEPTION(Cancelled, inner.checkpoint());
    QVERIFY_THROWS_EXCEPTION(Cancelled, inner.report(0.5));
    QVERIFY_THROWS_EXCEPTION(Cancelled, whole.part(0.1, Message::plain("next")));
    QVERIFY(!inner.stopAndKeep());
  }

  void keepingIsNotCancelling() {
    Recorder sink;
    StopRequest stop;
    Progress whole(sink, stop);
    QVERIFY(!whole.stopAndKeep());
    stop.ask(StopRequest::Kind::keep);
    QVERIFY(whole.stopAndKeep());
    whole.checkpoint();  // does not throw
    stop.ask(StopRequest::Kind::cancel);
    QVERIFY_THROWS_EXCEPTION(Cancelled, whole.checkpoint());
    stop.ask(StopRequest::Kind::keep);  // a cancel is never weakened
    QCOMPARE(stop.asked(), StopRequest::Kind::cancel);
  }

  void nobodyHasToListen() {
    Progress nobody;
    nobody.part(0.5, Message::plain("x")).report(0.7);
    nobody.preview({"p", {1, 1}, {0, 0, 0}});
    nobody.checkpoint();
    QVERIFY(!nobody.stopAndKeep());
  }

  void previewsArrive() {
    Recorder sink;
    StopRequest stop;
    Progress whole(sink, stop);
    whole.part(0.1, Message::plain("x")).preview({"flood", {1, 1}, {0, 0, 0}});
    QCOMPARE(sink.previews, std::vector<std::string>{"flood"});
  }
};

QTEST_APPLESS_MAIN(TestProgress)
#include "test_progress.moc"
