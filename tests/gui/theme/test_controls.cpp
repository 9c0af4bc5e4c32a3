// SPDX-License-Identifier: MIT
// Texts that somebody typed are shown as they are; choices have room or fold.
#include "theme/controls.h"

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTextDocumentFragment>
#include <QVBoxLayout>
#include <QtTest>

#include "theme/action_button.h"
#include "theme/readout.h"
#include "theme/theme.h"

using namespace relucent::gui;

Q_DECLARE_METATYPE(std::optional<Icon>)

class TestControls : public QObject {
  Q_OBJECT

  /// Sees whether a style sheet is in force when style, palette or type first change.
  class Witness : public QWidget {
   public:
    std::optional<bool> isStyled;

   protected:
    void changeEvent(QEvent* event) override {
      const bool isLook = event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange ||
                          event->type() == QEvent::FontChange;
      if (isLook && !isStyled) isStyled = !qApp->styleSheet().isEmpty();
    }
  };

 private slots:
  /// Law: another look is worked out once for each widget. Under a sheet, palette and type would be too,
  /// which took the whole wizard four times as long: over two seconds.
  void aLookIsWorkedOutOnce() {
    Theme::instance().apply(Look::light);
    Witness witness;
    witness.show();
    witness.isStyled.reset();
    Theme::instance().apply(Look::dark);
    QCOMPARE(witness.isStyled, std::optional(false));
    QVERIFY(!qApp->styleSheet().isEmpty());
    qApp->setStyleSheet({});
  }

  /// Law: a figure is never cut, however little room its caption has.
  void aReadoutShowsItsFigure() {
    Readout readout("milliseconds");
    const int usual = readout.minimumSizeHint().width();
    readout.setValue("239,7 ms");
    QVERIFY(readout.minimumSizeHint().width() >
            QFontMetrics(typeOf(type::readout, QFont::DemiBold)).horizontalAdvance("239,7 ms"));
    QVERIFY(readout.minimumSizeHint().width() > usual);
  }

  void aButtonSaysWhyItCannotBePressed_data() {
    QTest::addColumn<std::optional<Icon>>("icon");
    QTest::newRow("with an icon") << std::optional(Icon::drift);
    QTest::newRow("without") << std::optional<Icon>();
  }
  /// Law: the reason is painted, told and asks for room across, none down; gone, all is as before.
  void aButtonSaysWhyItCannotBePressed() {
    QFETCH(std::optional<Icon>, icon);
    Theme::instance().apply(Look::dark);
    ActionButton button(icon, "Check for drift");
    button.setAccessibleDescription("Ten photographs.");
    const QSize usual = button.sizeHint();
    const auto painted = [&button] {
      button.resize(270, button.sizeHint().height());
      return button.grab().toImage();
    };
    const QImage open = painted();
    const QString reason = "Confirm that the room is clear, and tell everybody.";
    button.setWhyNot(reason);
    QVERIFY(!button.isEnabled());
    QCOMPARE(button.accessibleDescription(), "Ten photographs. " + reason);
    QCOMPARE(whyNotPossible(button), reason);
    QCOMPARE(button.sizeHint().height(), usual.height());
    QVERIFY(button.sizeHint().width() > QFontMetrics(typeOf(type::note)).horizontalAdvance(reason));
    QCOMPARE(button.minimumSizeHint().height(), usual.height());
    QVERIFY(button.minimumSizeHint().width() <= usual.width());
    const QImage closed = painted();
    button.setWhyNot("Another reason.");
    QVERIFY(painted() != closed);  // it is seen
    QCOMPARE(button.accessibleDescription(), QString("Ten photographs. Another reason."));
    button.setWhyNot({});
    QVERIFY(button.isEnabled());
    QCOMPARE(button.accessibleDescription(), QString("Ten photographs."));
    QCOMPARE(button.sizeHint(), usual);
    QCOMPARE(painted(), open);
  }

  /// Law: of a button that stays shut, another reason is seen as soon as it is given.
  void anotherReasonIsPainted() {
    struct Paints : QObject {
      int count = 0;
      bool eventFilter(QObject*, QEvent* event) override {
        count += event->type() == QEvent::Paint ? 1 : 0;
        return false;
      }
    } paints;
    ActionButton button(QString("Keep everything"));
    button.resize(300, 40);
    button.setWhyNot("It is being read.");
    button.show();
    QVERIFY(QTest::qWaitForWindowExposed(&button));
    button.installEventFilter(&paints);
    QCoreApplication::processEvents();
    const int before = paints.count;
    button.setWhyNot("It is in use.");
    QTRY_VERIFY(paints.count > before);
  }

  /// Law: in a dialog, Enter presses the button with the focus, and the default one where none has it.
  void enterPressesTheButtonWithTheFocus_data() {
    QTest::addColumn<QString>("focused");
    QTest::addColumn<QString>("pressed");
    QTest::newRow("the default one") << "stay"
                                     << "stay";
    QTest::newRow("another") << "end"
                             << "end";
    QTest::newRow("one with a reason") << "why"
                                       << "why";
    QTest::newRow("none") << "name"
                          << "stay";
  }
  void enterPressesTheButtonWithTheFocus() {
    QFETCH(QString, focused);
    QFETCH(QString, pressed);
    QDialog dialog;
    QStringList all;
    auto* column = new QVBoxLayout(&dialog);
    auto* name = new QLineEdit;
    QPushButton *stay = buttonOf("stay", "primary"), *end = buttonOf("end"), *why = new ActionButton("why");
    column->addWidget(name);
    name->setObjectName("name");
    for (QPushButton* button : {stay, end, why}) {
      button->setObjectName(button->text());
      connect(button, &QPushButton::clicked, button, [&all, button] { all << button->text(); });
      column->addWidget(button);
    }
    stay->setDefault(true);
    dialog.show();
    QVERIFY(QTest::qWaitForWindowActive(&dialog));
    auto* widget = dialog.findChild<QWidget*>(focused);
    widget->setFocus();
    QTest::keyClick(widget, Qt::Key_Return);
    QCOMPARE(all, QStringList(pressed));
    // Held down, a key presses once.
    QKeyEvent again(QEvent::KeyPress, Qt::Key_Enter, Qt::KeypadModifier, {}, true);
    QCoreApplication::sendEvent(end, &again);
    QCOMPARE(all, QStringList(pressed));
  }

  /// Law: what cannot be chosen is fainter than what can, not drawn twice.
  void disabledWordsAreNotEtched() {
    Theme::instance().apply(Look::dark);
    QCOMPARE(QApplication::style()->styleHint(QStyle::SH_EtchDisabledText), 0);
  }

  /// Law: no label, nor its tooltip, takes a user's words for rich text.
  void usersWordsAreNoRichText_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("a name") << "Dome";
    QTest::newRow("what looks like markup") << "Dome <b>x";
    QTest::newRow("an entity") << "Dome &amp; <i>x</i>";
  }
  void usersWordsAreNoRichText() {
    QFETCH(QString, text);
    const std::unique_ptr<QLabel> label(labelOf(text));
    const std::unique_ptr<ElidedLabel> elided(elidedLabel("note"));
    elided->resize(1000, 20);
    elided->setWhole(text);
    for (const QLabel* shown : {label.get(), static_cast<QLabel*>(elided.get())}) {
      QCOMPARE(shown->textFormat(), Qt::PlainText);
      QCOMPARE(shown->text(), text);
    }
    const QString tip = elided->toolTip();
    QCOMPARE(Qt::mightBeRichText(tip) ? QTextDocumentFragment::fromHtml(tip).toPlainText() : tip, text);
  }

  /// Law: without room for a row what folds is as high as one line, all of which is seen, and chooses the
  /// same.
  void whatHasNoRoomFoldsIntoAList() {
    Segmented segments({"Picture", "Reachable light", "Difference", "Contradiction"});
    segments.foldIntoList("What is shown");
    segments.setOffered(3, false);
    const int row = segments.sizeHint().height(), wide = segments.sizeHint().width();
    auto* list = segments.findChild<QComboBox*>();
    QCOMPARE(list->accessibleName(), QString("What is shown"));
    const auto buttons = [&] {
      int visible = 0;
      for (const QPushButton* button : segments.findChildren<QPushButton*>())
        visible += button->isVisibleTo(&segments);
      return visible;
    };
    segments.resize(wide, row);
    QCoreApplication::sendPostedEvents();
    QVERIFY(!list->isVisibleTo(&segments));
    QCOMPARE(buttons(), 3);

    segments.resize(wide - 1, row);
    segments.show();
    QVERIFY(segments.heightForWidth(wide - 1) < 2 * row);
    QVERIFY(segments.minimumSizeHint().width() < wide - 1);
    QVERIFY(list->isVisibleTo(&segments));
    segments.resize(wide - 1, segments.heightForWidth(wide - 1));
    QVERIFY2(segments.rect().contains(list->geometry()) && list->height() >= list->sizeHint().height(),
             "the list is cut off");
    QCOMPARE(buttons(), 0);
    QCOMPARE(list->count(), 3);
    QSignalSpy chosen(&segments, &Segmented::chosen);
    Q_EMIT list->activated(2);
    QCOMPARE(chosen.size(), 1);
    QCOMPARE(chosen.at(0).at(0).toInt(), 2);
    QCOMPARE(segments.current(), 2);
    segments.setCurrent(1);
    QCOMPARE(list->currentIndex(), 1);
    segments.setOffered(3, true);
    QCOMPARE(list->count(), 4);

    // With room for it, the row is back.
    segments.resize(segments.sizeHint().width(), row);
    QVERIFY(!list->isVisibleTo(&segments));
    QCOMPARE(buttons(), 4);
  }

  /// Others are stacked, as they were.
  void whatDoesNotFoldIsStacked() {
    Segmented segments({"Corrected", "Original"});
    const int row = segments.sizeHint().height();
    QVERIFY(segments.heightForWidth(segments.sizeHint().width() - 1) > 2 * row);
  }

  /// Law: a remark that keeps its room is as high as what it said at most at this width, whatever it said and
  /// however wide it was before it was looked at.
  void aRemarkKeepsTheRoomOfWhatItSaid() {
    const QString much = QString("One sentence after another. ").repeated(12), little = "Little.";
    QWidget window;
    auto* column = new QVBoxLayout(&window);
    auto* remark = new Remark;
    remark->keepRoom();
    column->addWidget(remark);
    auto* below = new QLabel("below");
    column->addWidget(below);
    column->addStretch(1);
    remark->show(Remark::Kind::watch, "Sentence", much);
    remark->resize(40, 900);
    remark->show(Remark::Kind::watch, "Sentence", little);
    window.resize(300, 700);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QTRY_COMPARE(remark->height(), remark->heightForWidth(remark->width()));
    remark->show(Remark::Kind::watch, "Sentence", much);
    QTRY_COMPARE(remark->height(), remark->heightForWidth(remark->width()));
    const int place = below->y();
    remark->show(Remark::Kind::watch, "Sentence", little);
    QCoreApplication::processEvents();
    QCOMPARE(below->y(), place);
    window.resize(420, 700);
    QTRY_COMPARE(remark->height(), remark->heightForWidth(remark->width()));
  }
};

QTEST_MAIN(TestControls)
#include "test_controls.moc"
