// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/enum_names.h"

using namespace relucent;

namespace {

enum class Fruit { apple, pear, quince };
constexpr EnumName<Fruit> fruitNames[]{
    {Fruit::quince, "quince", "is cooked first"}, {Fruit::apple, "apple"}, {Fruit::pear, "pear"}};
constexpr EnumNames<Fruit> namesOf(Fruit) {
  return {"fruit", fruitNames};
}
enum class Nameless { one };

static_assert(NamedEnum<Fruit> && !NamedEnum<Nameless> && !NamedEnum<int>);
static_assert(nameOf(Fruit::pear) == "pear");

}  // namespace

class TestEnumNames : public QObject {
  Q_OBJECT

 private slots:
  void namesAndValuesAreTheSameBothWays() {
    for (Fruit fruit : allValues<Fruit>())
      QVERIFY(parsedName<Fruit>(nameOf(fruit), ErrorKind::usage) == fruit);
    for (const std::string& name : allNames<Fruit>()) QCOMPARE(nameOf(*valueNamed<Fruit>(name)), name);
  }

  void theTableSaysTheOrder() {
    QCOMPARE(allNames<Fruit>(), (std::vector<std::string>{"quince", "apple", "pear"}));
    QVERIFY((allValues<Fruit>() == std::vector{Fruit::quince, Fruit::apple, Fruit::pear}));
    QCOMPARE(descriptionOf(Fruit::quince), std::string_view("is cooked first"));
    QVERIFY(descriptionOf(Fruit::pear).empty());
  }

  void unknownNamesAreErrorsThatListTheKnownOnes_data() {
    QTest::addColumn<QByteArray>("name");
    for (const char* name : {"", "plum", "Apple", "apple ", "appl"}) QTest::newRow(name) << QByteArray(name);
  }
  void unknownNamesAreErrorsThatListTheKnownOnes() {
    QFETCH(QByteArray, name);
    QVERIFY(!valueNamed<Fruit>(name.toStdString()));
    for (ErrorKind kind : {ErrorKind::usage, ErrorKind::format}) {
      try {
        (void)parsedName<Fruit>(name.toStdString(), kind);
        QFAIL("an unknown name was taken");
      } catch (const Error& error) {
        QVERIFY(error.kind() == kind);
        const QString line = error.what();
        QVERIFY2(line.contains("fruit '" + name + "'"), error.what());
        QVERIFY2(line.contains("quince, apple, pear"), error.what());
      }
    }
  }
};

QTEST_GUILESS_MAIN(TestEnumNames)
#include "test_enum_names.moc"
